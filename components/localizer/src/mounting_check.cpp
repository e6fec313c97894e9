// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/mounting_check.hpp"

#include <cmath>

namespace panvo::localizer {
namespace {

constexpr double kShortest_m = 0.3;  // a step that says something of its direction
constexpr double kLongest_m = 5.0;   // within one pass

}  // namespace

void MountingCheck::add(const LandmarkSighting& sighting, const Remembered& at) {
  const auto before = last_;
  if (before && before->sighting.landmark_id == sighting.landmark_id) {
    const Eigen::Vector3d by_odometry = before->at.pose.odom_from_base.inverse() * at.pose.odom_from_base.translation();
    const double moved_m = by_odometry.norm();
    if (moved_m < kShortest_m) return;  // compared with a later one
    if (moved_m < kLongest_m) {
      const Eigen::Vector3d by_panoramas =
          before->sighting.landmark_from_base.inverse() * sighting.landmark_from_base.translation();
      cross_ += by_odometry.cross(by_panoramas);
      dot_ += by_odometry.dot(by_panoramas);
      way_m_ += moved_m;
    }
  }
  last_ = Last{sighting, at};
}

std::optional<MountingCheck::Misalignment> MountingCheck::misalignment() const {
  if (way_m_ < kEnough_m || dot_ <= 0.0) return std::nullopt;
  // A camera that is turned to the left sees the way turned to the right.
  const Misalignment found{-std::atan2(cross_.z(), dot_), -std::atan2(cross_.y(), dot_)};
  if (std::hypot(found.yaw_rad, found.pitch_rad) < kNotable_rad) return std::nullopt;
  return found;
}

}  // namespace panvo::localizer
