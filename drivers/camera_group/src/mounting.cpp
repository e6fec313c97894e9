// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_group/mounting.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>

#include "panvo/conversions/camera_info.hpp"
#include "panvo/conversions/transform_buffer.hpp"

namespace panvo::camera_group {
namespace {

using Placement = std::span<const double, 6>;
using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d base_from_optical(Placement place) {
  constexpr double kRadians = std::numbers::pi / 180.0;
  Isometry3d base_from_camera = Isometry3d::Identity();
  base_from_camera.translate(Vector3d(place[0], place[1], place[2]));
  base_from_camera.rotate(AngleAxisd(place[5] * kRadians, Vector3d::UnitZ()) *
                          AngleAxisd(place[4] * kRadians, Vector3d::UnitY()) *
                          AngleAxisd(place[3] * kRadians, Vector3d::UnitX()));
  // REP 103: x (right), y (down), z (forward) of the optical frame are -y, -z, x of the camera body.
  Eigen::Matrix3d camera_from_optical;
  camera_from_optical.col(0) = -Vector3d::UnitY();
  camera_from_optical.col(1) = -Vector3d::UnitZ();
  camera_from_optical.col(2) = Vector3d::UnitX();
  base_from_camera.rotate(camera_from_optical);
  return base_from_camera;
}

/// Between the rectified cameras there is only the baseline; the rotations of the rectification are undone on both
/// sides.
std::optional<Isometry3d> left_from_right(const std::vector<GroupImage>& images) {
  if (images.size() != 2 || !images[0].calibration || !images[1].calibration) return std::nullopt;
  const auto left = conversions::to_camera(*images[0].calibration),
             right = conversions::to_camera(*images[1].calibration);
  if (!left || !right) return std::nullopt;
  const Eigen::Translation3d step(right->baseline_m - left->baseline_m, 0.0, 0.0);
  return Isometry3d(left->rectified_from_raw.transpose()) * step * Isometry3d(right->rectified_from_raw);
}

}  // namespace

tf2_msgs::msg::TFMessage mounting(const std::vector<double>& mount, const std::vector<GroupImage>& images,
                                  std::int64_t stamp_ns) {
  constexpr std::size_t kEach = Placement::extent;
  tf2_msgs::msg::TFMessage message;
  if (mount.empty()) return message;
  const bool places_left_only = mount.size() == kEach && images.size() == 2;
  if (mount.size() != kEach * images.size() && !places_left_only) {
    throw std::invalid_argument(fmt::format(
        "mount: has {} numbers; write six (x, y, z in m; roll, pitch, yaw in degrees) for each of {} images, "
        "or six for the left camera of a pair",
        mount.size(), images.size()));
  }
  for (std::size_t i = 0; i < mount.size() / kEach; ++i) {
    message.transforms().push_back(
        conversions::to_static_transform(stamp_ns, "base_link", images[i].role.frame_id,
                                         base_from_optical(std::span(mount).subspan(i * kEach).first<kEach>())));
  }
  if (!places_left_only) return message;
  if (const auto right = left_from_right(images)) {
    message.transforms().push_back(conversions::to_static_transform(
        stamp_ns, "base_link", images[1].role.frame_id, base_from_optical(std::span(mount).first<kEach>()) * *right));
  }
  return message;
}

}  // namespace panvo::camera_group
