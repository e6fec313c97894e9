// SPDX-License-Identifier: Apache-2.0
#include "mounting.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>
#include <optional>
#include <span>

#include "panvo/conversions/camera_info.hpp"
#include "panvo/conversions/static_transforms.hpp"

namespace panvo::aravis_camera {
namespace {

constexpr std::size_t kNumbers = 6;

Eigen::Isometry3d base_from_optical(std::span<const double, kNumbers> mount) {
  const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180.0; };
  Eigen::Isometry3d base_from_camera = Eigen::Isometry3d::Identity();
  base_from_camera.translation() = Eigen::Vector3d(mount[0], mount[1], mount[2]);
  base_from_camera.linear() = (Eigen::AngleAxisd(radians(mount[5]), Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(radians(mount[4]), Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(radians(mount[3]), Eigen::Vector3d::UnitX()))
                                  .toRotationMatrix();
  // REP 103: forward, left, up of the camera's body are z, -x, -y of its optical frame.
  Eigen::Matrix3d camera_from_optical;
  camera_from_optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  base_from_camera.linear() = base_from_camera.linear() * camera_from_optical;
  return base_from_camera;
}

/// From the rectifications of both: in their rectified frames the right camera stands a baseline along +x of the left one.
std::optional<Eigen::Isometry3d> left_from_right(const CameraOfGroup& left, const CameraOfGroup& right) {
  if (!left.calibration || !right.calibration) return std::nullopt;
  const auto left_camera = conversions::to_camera(*left.calibration),
             right_camera = conversions::to_camera(*right.calibration);
  if (!left_camera || !right_camera) return std::nullopt;
  Eigen::Isometry3d rectified_left_from_rectified_right = Eigen::Isometry3d::Identity();
  rectified_left_from_rectified_right.translation().x() = right_camera->baseline_m - left_camera->baseline_m;
  return Eigen::Isometry3d(left_camera->rectified_from_raw.transpose()) * rectified_left_from_rectified_right *
         Eigen::Isometry3d(right_camera->rectified_from_raw);
}

}  // namespace

tf2_msgs::msg::TFMessage mounting(const std::vector<double>& mount, const std::vector<CameraOfGroup>& cameras,
                                  std::int64_t stamp_ns) {
  tf2_msgs::msg::TFMessage message;
  if (mount.empty()) return message;
  const auto place = [&](const CameraOfGroup& camera, const Eigen::Isometry3d& base_from_camera) {
    message.transforms().push_back(
        conversions::to_static_transform(stamp_ns, "base_link", camera.role.frame_id, base_from_camera));
  };
  const std::span numbers(mount);
  if (mount.size() == kNumbers * cameras.size()) {
    for (std::size_t i = 0; i < cameras.size(); ++i)
      place(cameras[i], base_from_optical(numbers.subspan(i * kNumbers).first<kNumbers>()));
  } else if (mount.size() == kNumbers && cameras.size() == 2) {
    const auto base_from_left = base_from_optical(numbers.first<kNumbers>());
    place(cameras[0], base_from_left);
    if (const auto from_right = left_from_right(cameras[0], cameras[1]))
      place(cameras[1], base_from_left * *from_right);
  } else {
    throw SettingsError(
        fmt::format("mount: has {} numbers; write six for each camera (x, y, z in m; roll, pitch, yaw in degrees), or "
                    "six for the left "
                    "one of a stereo pair",
                    mount.size()));
  }
  return message;
}

}  // namespace panvo::aravis_camera
