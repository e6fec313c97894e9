// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>

#include "panvo/interfaces/validity.hpp"
#include "validity_parts.hpp"

namespace panvo::interfaces {
namespace {

constexpr std::uint32_t kMaxSide_px = 1U << 16;
constexpr double kMaxFocal_px = 1e6;     // a telescope
constexpr double kMaxCoefficient = 1e6;  // of a distortion; a poor fit of a rational model reaches thousands
constexpr std::size_t kMaxCoefficients = 32;
constexpr double kMaxBaseline_m = 1e3;
constexpr double kRotationTolerance = 1e-3;
constexpr std::size_t kMaxPointFields = 256;

/// Bytes per pixel of an encoding in sensor_msgs/image_encodings; 0: unknown encoding. For nv21 and nv24 only the grey
/// plane counts, which precedes the colour plane.
std::uint32_t bytes_of_pixel(std::string_view encoding) {
  struct Encoding {
    std::string_view name;
    std::uint32_t bytes;
  };
  static constexpr Encoding kEncodings[] = {
      {"mono8", 1},        {"mono16", 2},       {"bgr8", 3},         {"rgb8", 3},        {"bgra8", 4},
      {"rgba8", 4},        {"bgr16", 6},        {"rgb16", 6},        {"bgra16", 8},      {"rgba16", 8},
      {"bayer_rggb8", 1},  {"bayer_bggr8", 1},  {"bayer_gbrg8", 1},  {"bayer_grbg8", 1}, {"bayer_rggb16", 2},
      {"bayer_bggr16", 2}, {"bayer_gbrg16", 2}, {"bayer_grbg16", 2}, {"yuv422", 2},      {"yuv422_yuy2", 2},
      {"uyvy", 2},         {"yuyv", 2},         {"nv21", 1},         {"nv24", 1}};
  for (const auto& known : kEncodings) {
    if (known.name == encoding) return known.bytes;
  }
  // OpenCV types with 1 to 4 channels: 8UC1, 32FC3.
  for (const auto& [depth, bytes] : {Encoding{"8U", 1}, Encoding{"8S", 1}, Encoding{"16U", 2}, Encoding{"16S", 2},
                                     Encoding{"32S", 4}, Encoding{"32F", 4}, Encoding{"64F", 8}}) {
    if (!encoding.starts_with(depth) || encoding.substr(depth.size()).size() != 2) continue;
    const char channels = encoding.back();
    if (encoding[depth.size()] == 'C' && channels >= '1' && channels <= '4') {
      return bytes * static_cast<std::uint32_t>(channels - '0');
    }
  }
  return 0;
}

void check_size(Check& check, std::uint32_t width, std::uint32_t height) {
  check.require(width <= kMaxSide_px && height <= kMaxSide_px, "width or height", "exceeds 65536 px");
}

bool is_zero(std::span<const double> values) {
  return std::ranges::all_of(values, [](double value) { return value == 0.0; });
}

bool is_rotation(const std::array<double, 9>& r) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      double product = 0.0;
      for (std::size_t k = 0; k < 3; ++k) product += r[3 * i + k] * r[3 * j + k];
      if (!(std::abs(product - (i == j ? 1.0 : 0.0)) <= kRotationTolerance)) return false;
    }
  }
  const double determinant =
      r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) + r[2] * (r[3] * r[7] - r[4] * r[6]);
  return determinant > 0.0;
}

/// REP 145: -1 in the first element marks a quantity that is not measured.
bool is_measured(const std::array<double, 9>& covariance) { return covariance[0] != -1.0; }

}  // namespace

Problem problem_of(const sensor_msgs::msg::Image& message) {
  Check check;
  check_header(check, message.header());
  check.require(message.width() > 0 && message.height() > 0, "width or height", "is 0");
  check_size(check, message.width(), message.height());
  const std::uint32_t pixel_bytes = bytes_of_pixel(message.encoding());
  check.require(pixel_bytes > 0, "encoding", "is not in sensor_msgs/image_encodings");
  if (!check.holds()) return check.problem();
  const std::uint64_t row_bytes = std::uint64_t{message.width()} * pixel_bytes;
  const std::uint64_t step = message.step(), size = message.data().size();
  check.require(step >= row_bytes, "step", "is too small for a row");
  check.require(size >= step * (message.height() - 1) + row_bytes, "data", "is shorter than height rows of step bytes");
  return check.problem();
}

Problem problem_of(const sensor_msgs::msg::CompressedImage& message) {
  Check check;
  check_header(check, message.header());
  check.name("format", message.format());
  return check.problem();
}

Problem problem_of(const sensor_msgs::msg::CameraInfo& message) {
  Check check;
  check_header(check, message.header());
  check_size(check, message.width(), message.height());
  check.name("distortion_model", message.distortion_model());
  check.at_most("d", message.d().size(), kMaxCoefficients).bounded("d", message.d(), kMaxCoefficient);
  check.bounded("k", message.k(), kMaxFocal_px);
  check.finite("r", message.r()).finite("p", message.p());
  const auto& p = message.p();
  const double focal_px = std::abs(p[0]);
  for (const std::size_t i : {0, 1, 2, 4, 5, 6, 8, 9, 10}) check.bounded("p", {p[i]}, kMaxFocal_px);
  for (const std::size_t i : {3, 7, 11}) check.bounded("p", {p[i]}, kMaxBaseline_m * std::max(1.0, focal_px));
  check.require(is_zero(message.r()) || is_rotation(message.r()), "r", "is not a rotation matrix");
  return check.problem();
}

Problem problem_of(const sensor_msgs::msg::Imu& message) {
  Check check;
  check_header(check, message.header());
  if (is_measured(message.orientation_covariance())) {
    check_rotation(check, "orientation", message.orientation());
    check.covariance("orientation_covariance", message.orientation_covariance());
  }
  if (is_measured(message.angular_velocity_covariance())) {
    const auto& rate = message.angular_velocity();
    check.bounded("angular_velocity", {rate.x(), rate.y(), rate.z()}, kMaxRate);
    check.covariance("angular_velocity_covariance", message.angular_velocity_covariance());
  }
  if (is_measured(message.linear_acceleration_covariance())) {
    const auto& acceleration = message.linear_acceleration();
    check.bounded("linear_acceleration", {acceleration.x(), acceleration.y(), acceleration.z()}, kMaxRate);
    check.covariance("linear_acceleration_covariance", message.linear_acceleration_covariance());
  }
  return check.problem();
}

Problem problem_of(const sensor_msgs::msg::PointCloud2& message) {
  Check check;
  check_header(check, message.header());
  check.at_most("fields", message.fields().size(), kMaxPointFields);
  if (!check.holds()) return check.problem();
  const std::uint64_t point = message.point_step(), row = message.row_step();
  for (const auto& field : message.fields()) {
    check.require(field.offset() < point || point == 0, "fields", "contain an offset beyond point_step");
  }
  check.require(row >= point * message.width(), "row_step", "is too small for width points");
  check.require(message.data().size() >= row * message.height(), "data",
                "is shorter than height rows of row_step bytes");
  return check.problem();
}

}  // namespace panvo::interfaces
