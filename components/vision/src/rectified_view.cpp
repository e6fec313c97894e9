// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "panvo/vision/camera_model.hpp"
#include "panvo/vision/pose.hpp"
#include "panvo/vision/stereo_calibration.hpp"

namespace panvo::vision {
namespace {

constexpr double kWidest_rad = 110.0 * std::numbers::pi / 180.0;
constexpr int kBorderSteps = 64;  // samples along each border
constexpr int kShrinkings = 400;
constexpr double kShrink = 0.99;

/// Rectangle in the plane z = 1 of the rectified frame.
struct Window {
  double left, top, right, bottom;
};

/// Whether the border of the window lies inside the image of the camera.
bool sees(const CameraModel& model, const Eigen::Matrix3d& rectified_from_raw, const Window& window) {
  const auto& pinhole = model.camera().pinhole;
  const auto is_seen = [&](double x, double y) {
    const auto pixel = model.project(rectified_from_raw.transpose() * Eigen::Vector3d(x, y, 1.0));
    return pixel && pinhole.contains(*pixel);
  };
  for (int i = 0; i <= kBorderSteps; ++i) {
    const double share = static_cast<double>(i) / kBorderSteps;
    const double x = std::lerp(window.left, window.right, share);
    const double y = std::lerp(window.top, window.bottom, share);
    if (!is_seen(x, window.top) || !is_seen(x, window.bottom) || !is_seen(window.left, y) || !is_seen(window.right, y))
      return false;
  }
  return true;
}

/// Half height of the largest window with the image's aspect ratio around `centre` that both cameras see.
std::optional<double> half_height(const std::vector<std::pair<const CameraModel*, Eigen::Matrix3d>>& eyes,
                                  const Eigen::Vector2d& centre, double aspect, double widest) {
  double half = std::min(widest, widest / aspect);
  for (int i = 0; i < kShrinkings; ++i, half *= kShrink) {
    const Window window{centre.x() - aspect * half, centre.y() - half, centre.x() + aspect * half, centre.y() + half};
    if (std::all_of(eyes.begin(), eyes.end(), [&](const auto& eye) { return sees(*eye.first, eye.second, window); }))
      return half;
  }
  return std::nullopt;
}

/// Image centre, projected to the rectified plane.
Eigen::Vector2d middle(const CameraModel& model, const Eigen::Matrix3d& rectified_from_raw) {
  const auto& pinhole = model.camera().pinhole;
  const auto direction = model.unproject({0.5 * (pinhole.width - 1), 0.5 * (pinhole.height - 1)});
  if (!direction) return Eigen::Vector2d::Zero();
  const Eigen::Vector3d turned = rectified_from_raw * *direction;
  return turned.z() > 0.2 ? Eigen::Vector2d(turned.head<2>() / turned.z()) : Eigen::Vector2d::Zero();
}

CameraModel model_of(const char* name, const LensCamera& lens) {
  try {
    return CameraModel(lens);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string(name) + " " + error.what());
  }
}

[[noreturn]] void refuse_sizes(const PinholeCamera& left, const PinholeCamera& right) {
  std::ostringstream text;
  text << "the left camera has " << left.width << " x " << left.height << " px, the right " << right.width << " x "
       << right.height << " px; a stereo pair needs equal image sizes";
  throw std::invalid_argument(text.str());
}

[[noreturn]] void refuse_place(const Eigen::Vector3d& baseline_m) {
  std::ostringstream text;
  text.precision(3);
  text << std::fixed << "the right camera is " << baseline_m.x() << " m to the right of the left one, "
       << baseline_m.y() << " m below and " << baseline_m.z()
       << " m ahead of it; the cameras must be mounted side by side: are left and right swapped?";
  throw std::invalid_argument(text.str());
}

}  // namespace

RectifiedStereo rectify_view(const StereoCalibration& calibration) {
  const auto& [left, right, right_from_left] = calibration;
  const auto& size = left.pinhole;
  if (size.width != right.pinhole.width || size.height != right.pinhole.height) refuse_sizes(size, right.pinhole);
  const Eigen::Vector3d half_turn = 0.5 * so3_log(right_from_left.linear());
  const Eigen::Matrix3d middle_from_left = so3_exp(half_turn);
  const Eigen::Matrix3d middle_from_right = so3_exp(-half_turn);
  const Eigen::Vector3d baseline = -(middle_from_right * right_from_left.translation());
  if (!(baseline.x() > baseline.tail<2>().norm())) refuse_place(baseline);
  const Eigen::Matrix3d along_rows =
      Eigen::Quaterniond::FromTwoVectors(baseline, Eigen::Vector3d::UnitX()).toRotationMatrix();
  RectifiedStereo pair;
  pair.baseline_m = baseline.norm();
  pair.rectified_left_from_left = along_rows * middle_from_left;
  pair.rectified_right_from_right = along_rows * middle_from_right;

  const auto left_model = model_of("left camera", left), right_model = model_of("right camera", right);
  const Eigen::Vector2d centre =
      0.5 * (middle(left_model, pair.rectified_left_from_left) + middle(right_model, pair.rectified_right_from_right));
  const double aspect = static_cast<double>(size.width - 1) / (size.height - 1);
  const auto half =
      half_height({{&left_model, pair.rectified_left_from_left}, {&right_model, pair.rectified_right_from_right}},
                  centre, aspect, std::tan(0.5 * kWidest_rad));
  if (!half)
    throw std::invalid_argument(
        "the fields of view of the two cameras do not overlap in a rectified image; do both face the same way?");
  const double focal = 0.5 * (size.height - 1) / *half;
  pair.camera = {
      focal,      focal,      0.5 * (size.width - 1) - focal * centre.x(), 0.5 * (size.height - 1) - focal * centre.y(),
      size.width, size.height};
  return pair;
}

}  // namespace panvo::vision
