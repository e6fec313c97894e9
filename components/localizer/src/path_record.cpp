// SPDX-License-Identifier: Apache-2.0
#include "path_record.hpp"

#include <cstdlib>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"

namespace panvo::localizer {

bool PathRecord::add(std::int64_t stamp_ns, const Eigen::Isometry3d& frame_from_base) {
  const bool is_due =
      poses_.empty() || (poses_.back().frame_from_base.translation() - frame_from_base.translation()).norm() >= step_m_;
  if (is_due) poses_.push_back({stamp_ns, frame_from_base});
  if (poses_.size() > max_poses_) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < poses_.size(); i += 2) poses_[kept++] = poses_[i];
    poses_.resize(kept);
    step_m_ *= 2.0;
  }
  if (published_ns_ && static_cast<double>(std::abs(stamp_ns - *published_ns_)) < period_s_ * 1e9) return false;
  published_ns_ = stamp_ns;
  return true;
}

nav_msgs::msg::Path PathRecord::message(const std::string& frame) const {
  nav_msgs::msg::Path path;
  path.header().frame_id(frame);
  if (!poses_.empty()) path.header().stamp(conversions::to_stamp(poses_.back().stamp_ns));
  path.poses().reserve(poses_.size());
  for (const auto& pose : poses_) {
    geometry_msgs::msg::PoseStamped stamped;
    stamped.header().stamp(conversions::to_stamp(pose.stamp_ns));
    stamped.header().frame_id(frame);
    stamped.pose(conversions::to_pose(pose.frame_from_base));
    path.poses().push_back(stamped);
  }
  return path;
}

}  // namespace panvo::localizer
