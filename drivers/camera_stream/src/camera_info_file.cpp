// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/camera_info_file.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace panvo::camera_stream {
namespace {

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : path_(path) {
    try {
      root_ = YAML::LoadFile(path.string());
    } catch (const YAML::BadFile&) {
      throw CalibrationFileError(path.string() + ": cannot be opened; check that it exists and is readable");
    } catch (const YAML::Exception& error) {
      throw CalibrationFileError(fmt::format("{}:{}: is not YAML: {}", path.string(), error.mark.line + 1, error.msg));
    }
    if (!root_.IsMap())
      throw CalibrationFileError(path.string() + ": has no `key: value` lines; is it a camera_info file?");
  }

  std::uint32_t size_px(const char* key) const {
    const auto value = read<std::int64_t>(at(key), key, "must be a whole number");
    if (value <= 0 || value > 1 << 16) fail(at(key), key, fmt::format("is {}, which is not an image size", value));
    return static_cast<std::uint32_t>(value);
  }

  std::string text(const char* key) const { return read<std::string>(at(key), key, "must be a string"); }

  /// The numbers of a matrix: a list, or a map with `data`.
  std::vector<double> numbers(const char* key) const {
    const YAML::Node node = at(key);
    const YAML::Node list = node.IsMap() ? node["data"] : node;
    auto values = read<std::vector<double>>(list, key, "must be a list of numbers, or a matrix (rows, cols, data)");
    if (std::any_of(values.begin(), values.end(), [](double value) { return !std::isfinite(value); }))
      fail(node, key, "has a value that is not finite");
    return values;
  }

  template <class Array>
  void read_into(const char* key, Array& array) const {
    const auto values = numbers(key);
    if (values.size() != array.size())
      fail(at(key), key, fmt::format("has {} numbers where {} are needed", values.size(), array.size()));
    std::copy(values.begin(), values.end(), array.begin());
  }

  [[noreturn]] void fail(const YAML::Node& node, const char* key, const std::string& what) const {
    throw CalibrationFileError(fmt::format("{}:{}: {} {}", path_.string(), node.Mark().line + 1, key, what));
  }

  YAML::Node at(const char* key) const {
    if (!root_[key]) throw CalibrationFileError(fmt::format("{}: {} is missing; add it", path_.string(), key));
    return root_[key];
  }

 private:
  template <class Value>
  Value read(const YAML::Node& node, const char* key, const char* what) const {
    Value value{};
    if (!node.IsDefined() || !YAML::convert<Value>::decode(node, value)) fail(at(key), key, what);
    return value;
  }

  std::filesystem::path path_;
  YAML::Node root_;
};

}  // namespace

sensor_msgs::msg::CameraInfo read_camera_info(const std::filesystem::path& file) {
  const Reader reader(file);
  sensor_msgs::msg::CameraInfo info;
  info.width(reader.size_px("image_width"));
  info.height(reader.size_px("image_height"));
  info.distortion_model(reader.text("distortion_model"));
  info.d() = reader.numbers("distortion_coefficients");
  reader.read_into("camera_matrix", info.k());
  reader.read_into("rectification_matrix", info.r());
  reader.read_into("projection_matrix", info.p());
  if (info.k()[0] <= 0.0 || info.k()[4] <= 0.0)
    reader.fail(reader.at("camera_matrix"), "camera_matrix", "has a focal length that is not positive");
  return info;
}

std::string size_problem(const sensor_msgs::msg::CameraInfo& info, int width, int height) {
  if (std::cmp_equal(info.width(), width) && std::cmp_equal(info.height(), height)) return {};
  return fmt::format(
      "the calibration is for {} x {} px, the camera sends {} x {} px: set the camera to the calibrated size, "
      "or calibrate again",
      info.width(), info.height(), width, height);
}

}  // namespace panvo::camera_stream
