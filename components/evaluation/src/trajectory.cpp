// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/trajectory.hpp"

#include <algorithm>
#include <iterator>

namespace panvo::evaluation {

double path_length_m(const Trajectory& trajectory) {
  double length = 0.0;
  for (std::size_t i = 1; i < trajectory.poses.size(); ++i) {
    length +=
        (trajectory.poses[i].world_from_base.translation() - trajectory.poses[i - 1].world_from_base.translation())
            .norm();
  }
  return length;
}

std::int64_t median_period_ns(const Trajectory& trajectory) {
  if (trajectory.poses.size() < 2) return 0;
  std::vector<std::int64_t> periods;
  for (std::size_t i = 1; i < trajectory.poses.size(); ++i) {
    periods.push_back(trajectory.poses[i].stamp_ns - trajectory.poses[i - 1].stamp_ns);
  }
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
}

Eigen::Isometry3d interpolate(const StampedPose& before, const StampedPose& after, std::int64_t stamp_ns) {
  const double share =
      static_cast<double>(stamp_ns - before.stamp_ns) / static_cast<double>(after.stamp_ns - before.stamp_ns);
  const Eigen::Quaterniond first(before.world_from_base.linear());
  const Eigen::Quaterniond second(after.world_from_base.linear());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = first.slerp(share, second).normalized().toRotationMatrix();
  pose.translation() =
      (1.0 - share) * before.world_from_base.translation() + share * after.world_from_base.translation();
  return pose;
}

std::optional<Eigen::Isometry3d> pose_at(const std::vector<StampedPose>& poses, std::int64_t stamp_ns) {
  const auto after = std::lower_bound(poses.begin(), poses.end(), stamp_ns,
                                      [](const StampedPose& pose, std::int64_t at) { return pose.stamp_ns < at; });
  if (after == poses.end()) return std::nullopt;
  if (after->stamp_ns == stamp_ns) return after->world_from_base;
  if (after == poses.begin()) return std::nullopt;
  return interpolate(*std::prev(after), *after, stamp_ns);
}

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation) {
  // From the quaternion, because the arc cosine of the trace loses all digits of angles below 1e-8.
  const Eigen::AngleAxisd angle_axis{Eigen::Quaterniond(rotation)};
  return angle_axis.angle() * angle_axis.axis();
}

}  // namespace panvo::evaluation
