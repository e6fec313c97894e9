// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "panvo/vision/pose.hpp"

namespace panvo::all_round_odometry {

/// Of odometry, with what has accumulated since its start.
struct Pose {
  Eigen::Isometry3d odom_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
};

/// One result of the stereo odometry.
struct StereoPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d odom_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();  ///< as vision::pose_error, growing from the start
  bool is_reliable = true;                                 ///< false: not measured since the pose before
};

/// Recent poses of the stereo odometry, in order of stamps.
class StereoHistory {
 public:
  void add(const StereoPose& pose) { poses_.push_back(pose); }
  void remove_first() { poses_.pop_front(); }
  void clear() { poses_.clear(); }

  bool empty() const noexcept { return poses_.empty(); }
  std::size_t size() const noexcept { return poses_.size(); }
  const StereoPose& operator[](std::size_t index) const { return poses_[index]; }
  const StereoPose& front() const { return poses_.front(); }
  const StereoPose& back() const { return poses_.back(); }
  /// Index of the first pose not before a time.
  std::size_t first_from(std::int64_t stamp_ns) const;

  /// Interpolated; nullopt outside the history, and between poses too far apart for that.
  std::optional<Pose> at(std::int64_t stamp_ns) const;
  /// The motion between two times; nullopt if the stereo odometry has not measured all of it.
  std::optional<Eigen::Isometry3d> measured(std::int64_t from_ns, std::int64_t to_ns) const;

 private:
  std::deque<StereoPose> poses_;
};

}  // namespace panvo::all_round_odometry
