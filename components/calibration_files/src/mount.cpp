// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration_files/mount.hpp"

#include <numbers>

namespace panvo::calibration_files {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

Eigen::Matrix3d base_from_forward() {
  Eigen::Matrix3d rotation;
  rotation << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return rotation;
}

Eigen::Matrix3d rotation_of(const Mount& mount) {
  return (Eigen::AngleAxisd(kDegree * mount.yaw_deg, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(kDegree * mount.pitch_deg, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(kDegree * mount.roll_deg, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::Isometry3d base_from_camera(const Mount& mount) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation_of(mount) * base_from_forward();
  pose.translation() = mount.position_m;
  return pose;
}

Mount read_mount(YamlMap& map, const Mount& instead) {
  Mount mount;
  mount.yaw_deg = map.number("yaw_deg", {-360.0, 360.0, "degrees"}, instead.yaw_deg);
  mount.pitch_deg = map.number("pitch_deg", {-180.0, 180.0, "degrees"}, instead.pitch_deg);
  mount.roll_deg = map.number("roll_deg", {-360.0, 360.0, "degrees"}, instead.roll_deg);
  mount.position_m = instead.position_m;
  if (map.has("position_m"))
    mount.position_m = Eigen::Map<const Eigen::Vector3d>(map.numbers("position_m", 3, {-100.0, 100.0, "m"}).data());
  return mount;
}

}  // namespace panvo::calibration_files
