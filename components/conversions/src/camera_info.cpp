// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/camera_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "panvo/conversions/time.hpp"

namespace panvo::conversions {
namespace {

using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

bool equal(const vision::PinholeCamera& a, const vision::PinholeCamera& b) {
  return a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy && a.width == b.width && a.height == b.height;
}

template <std::size_t size>
bool all_finite(const std::array<double, size>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

bool PairedCamera::operator==(const PairedCamera& other) const {
  return equal(raw.pinhole, other.raw.pinhole) && raw.model == other.raw.model &&
         raw.distortion == other.raw.distortion && rectified_from_raw == other.rectified_from_raw &&
         equal(rectified, other.rectified) && baseline_m == other.baseline_m;
}

bool is_rectified(const PairedCamera& camera) {
  constexpr double kTolerance = 1e-9;  // far below a visible shift
  const auto& raw = camera.raw.pinhole;
  const auto& rectified = camera.rectified;
  const double difference_px = std::max({std::abs(raw.fx - rectified.fx), std::abs(raw.fy - rectified.fy),
                                         std::abs(raw.cx - rectified.cx), std::abs(raw.cy - rectified.cy)});
  return vision::is_straight(camera.raw) && camera.rectified_from_raw.isIdentity(kTolerance) &&
         difference_px <= kTolerance * raw.fx && raw.width == rectified.width && raw.height == rectified.height;
}

PairedCamera left_camera(const vision::StereoCalibration& calibration, const vision::RectifiedStereo& rectified) {
  return {calibration.left, rectified.rectified_left_from_left, rectified.camera, 0.0};
}

PairedCamera right_camera(const vision::StereoCalibration& calibration, const vision::RectifiedStereo& rectified) {
  return {calibration.right, rectified.rectified_right_from_right, rectified.camera, rectified.baseline_m};
}

sensor_msgs::msg::CameraInfo to_camera_info(const PairedCamera& camera, std::int64_t stamp_ns,
                                            const std::string& frame_id) {
  const auto& raw = camera.raw.pinhole;
  const auto& rectified = camera.rectified;
  sensor_msgs::msg::CameraInfo info;
  info.header().stamp(to_stamp(stamp_ns));
  info.header().frame_id(frame_id);
  info.width(static_cast<std::uint32_t>(raw.width));
  info.height(static_cast<std::uint32_t>(raw.height));
  info.distortion_model(std::string(vision::ros_name(camera.raw.model)));
  info.d() = vision::ros_coefficients(camera.raw);
  info.k({raw.fx, 0, raw.cx, 0, raw.fy, raw.cy, 0, 0, 1});
  Eigen::Map<RowMajor3d>(info.r().data()) = camera.rectified_from_raw;
  const double tx_px_m = camera.baseline_m == 0.0 ? 0.0 : -rectified.fx * camera.baseline_m;
  info.p({rectified.fx, 0, rectified.cx, tx_px_m, 0, rectified.fy, rectified.cy, 0, 0, 0, 1, 0});
  return info;
}

Result<PairedCamera> to_camera(const sensor_msgs::msg::CameraInfo& info) {
  const auto& k = info.k();
  const auto& p = info.p();
  if (k[0] == 0.0) return Reason{"is not calibrated (K is zero); calibrate the camera"};
  if (p[0] == 0.0 || info.r()[8] == 0.0)
    return Reason{"is calibrated as a single camera (R or P is zero); calibrate both cameras as a stereo pair"};
  if (!all_finite(k) || !all_finite(info.r()) || !all_finite(p))
    return Reason{"holds a value in K, R or P that is not a number"};
  if (info.binning_x() > 1 || info.binning_y() > 1 || info.roi().x_offset() != 0 || info.roi().y_offset() != 0) {
    return Reason{
        "sets binning or a region of interest, which is not supported; calibrate at the published image size"};
  }
  const Eigen::Matrix3d rotation = Eigen::Map<const RowMajor3d>(info.r().data());
  if ((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm() > 1e-3 || rotation.determinant() < 0.0) {
    return Reason{"has an R that is not a rotation matrix; calibrate again"};
  }
  const int width = static_cast<int>(info.width());
  const int height = static_cast<int>(info.height());
  PairedCamera camera;
  try {
    camera.raw = vision::lens_camera(info.distortion_model(), info.d(), {k[0], k[4], k[2], k[5], width, height});
  } catch (const std::invalid_argument& error) {
    return Reason{error.what()};
  }
  camera.rectified_from_raw = rotation;
  camera.rectified = {p[0], p[5], p[2], p[6], width, height};
  camera.baseline_m = p[3] == 0.0 ? 0.0 : -p[3] / p[0];
  return camera;
}

Result<vision::RectifiedStereo> to_stereo(const PairedCamera& left, const PairedCamera& right) {
  if (!equal(left.rectified, right.rectified)) {
    return Reason{"left and right rectify to different cameras (size or P differ); calibrate both as one stereo pair"};
  }
  vision::RectifiedStereo stereo;
  stereo.camera = left.rectified;
  stereo.baseline_m = right.baseline_m - left.baseline_m;
  stereo.rectified_left_from_left = left.rectified_from_raw;
  stereo.rectified_right_from_right = right.rectified_from_raw;
  if (const auto problems = vision::validate(stereo); !problems.empty()) return Reason{problems.front()};
  return stereo;
}

}  // namespace panvo::conversions
