// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/camchain_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "panvo/calibration/calibration_error.hpp"
#include "panvo/vision/pose.hpp"
#include "yaml_document.hpp"

namespace panvo::calibration {
namespace {

using vision::LensModel;

constexpr double kRotationTolerance = 1e-3;
constexpr const char* kKind = "a Kalibr camchain YAML with cam0, cam1, ...";

vision::LensCamera read_lens(const YamlDocument& camera) {
  const std::string model = camera.text("camera_model");
  const bool is_omni = model == "omni";
  if (!is_omni && model != "pinhole")
    camera.fail("camera_model", fmt::format("'{}' is not supported; calibrate with pinhole or omni", model));
  const auto size = camera.numbers("resolution", 2);
  auto intrinsics = camera.numbers("intrinsics", is_omni ? 5 : 4);
  double xi = 0.0;
  if (is_omni) {
    xi = intrinsics.front();
    intrinsics.erase(intrinsics.begin());
  }
  const vision::PinholeCamera pinhole{
      intrinsics[0], intrinsics[1], intrinsics[2], intrinsics[3], static_cast<int>(size[0]), static_cast<int>(size[1])};
  if (pinhole.width <= 0 || pinhole.height <= 0) camera.fail("resolution", "must be width and height in px");
  if (!(pinhole.fx > 0.0 && pinhole.fy > 0.0)) camera.fail("intrinsics", "must have positive focal lengths");
  const std::string distortion = camera.text("distortion_model");
  auto coefficients = distortion == "none" ? std::vector<double>() : camera.numbers("distortion_coeffs", 4);
  if (is_omni && distortion != "radtan" && distortion != "none")
    camera.fail("distortion_model",
                fmt::format("'{}' is not supported with camera_model omni; calibrate with omni-radtan", distortion));
  if (is_omni) {
    coefficients.resize(4, 0.0);
    coefficients.push_back(xi);
  }
  try {
    return vision::lens_camera(is_omni ? "mei" : distortion == "none" ? "" : distortion, coefficients, pinhole);
  } catch (const std::invalid_argument& error) {
    camera.fail("distortion_model", std::string(": the camera ") + error.what());
  }
}

Eigen::Isometry3d read_step(const YamlDocument& camera) {
  const auto values = camera.numbers("T_cn_cnm1", 16);
  const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  if ((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm() > kRotationTolerance ||
      rotation.determinant() < 0.0)
    camera.fail("T_cn_cnm1", "is not a rigid transform (4 x 4, row by row)");
  Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
  step.linear() = vision::nearest_rotation(rotation);
  step.translation() = matrix.topRightCorner<3, 1>();
  return step;
}

std::string rows_of(const Eigen::Isometry3d& pose) {
  std::string text;
  for (int row = 0; row < 4; ++row)
    text += fmt::format("  - [{:.10g}, {:.10g}, {:.10g}, {:.10g}]\n", pose.matrix()(row, 0), pose.matrix()(row, 1),
                        pose.matrix()(row, 2), pose.matrix()(row, 3));
  return text;
}

}  // namespace

std::vector<NamedCamera> read_camchain(const std::filesystem::path& file) {
  const YamlDocument chain(file, kKind);
  std::vector<NamedCamera> cameras;
  for (std::size_t i = 0;; ++i) {
    const std::string name = fmt::format("cam{}", i);
    if (!chain.has(name.c_str())) break;
    const YAML::Node node = chain.at(name.c_str());
    if (!node.IsMap()) chain.fail(name.c_str(), "must be a map of `key: value` lines");
    const YamlDocument camera(file, node);
    NamedCamera named{name, {read_lens(camera)}};
    if (i > 0) named.camera.camera_from_reference = read_step(camera) * cameras.back().camera.camera_from_reference;
    cameras.push_back(named);
  }
  if (cameras.empty()) throw CalibrationError(fmt::format("{}: cam0 is missing; expected {}", file.string(), kKind));
  return cameras;
}

std::string camchain_text(const std::vector<NamedCamera>& cameras) {
  std::string text;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const auto& [lens, camera_from_reference] = cameras[i].camera;
    const auto coefficients = vision::ros_coefficients(lens);
    const bool is_unknown =
        lens.model == LensModel::kRational || (lens.model == LensModel::kPlumbBob && coefficients[4] != 0.0);
    if (is_unknown)
      throw CalibrationError(fmt::format(
          "{}: Kalibr's radtan has neither k3 nor a rational polynomial; recalibrate without them", cameras[i].name));
    const bool is_omni = lens.model == LensModel::kMei;
    text += fmt::format("cam{}:\n", i);
    if (i > 0)
      text += "  T_cn_cnm1:\n" + rows_of(camera_from_reference * cameras[i - 1].camera.camera_from_reference.inverse());
    const auto& p = lens.pinhole;
    text += fmt::format("  camera_model: {}\n  distortion_model: {}\n  distortion_coeffs: [{:.12g}]\n",
                        is_omni ? "omni" : "pinhole", lens.model == LensModel::kEquidistant ? "equidistant" : "radtan",
                        fmt::join(coefficients.begin(), coefficients.begin() + 4, ", "));
    text += fmt::format("  intrinsics: [{}{:.12g}, {:.12g}, {:.12g}, {:.12g}]\n  resolution: [{}, {}]\n",
                        is_omni ? fmt::format("{:.12g}, ", lens.xi) : "", p.fx, p.fy, p.cx, p.cy, p.width, p.height);
    text += fmt::format("  rostopic: /{}/image_raw\n", cameras[i].name);
  }
  return text;
}

}  // namespace panvo::calibration
