// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace panvo::evaluation {

// Pose of the base at a stamp. `world` is the odom or map frame of an estimate, or the frame of the ground truth.
struct StampedPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d world_from_base = Eigen::Isometry3d::Identity();
};

// Finite poses with strictly increasing stamps; the readers guarantee both.
struct Trajectory {
  std::vector<StampedPose> poses;
  std::filesystem::path source;  // file it was read from; empty if created in memory
  std::string format;            // recognised format, for messages: "TUM", "EuRoC", "KITTI ..."
};

// Length of the polyline through the positions, m.
double path_length_m(const Trajectory& trajectory);

// Median time between poses, ns; 0 for fewer than two poses.
std::int64_t median_period_ns(const Trajectory& trajectory);

// The pose at `stamp_ns` between two poses: position by linear, orientation by spherical linear interpolation.
// Requires before.stamp_ns < after.stamp_ns.
Eigen::Isometry3d interpolate(const StampedPose& before, const StampedPose& after, std::int64_t stamp_ns);

// The pose at `stamp_ns`, interpolated between two of `poses`; nullopt outside their time span.
std::optional<Eigen::Isometry3d> pose_at(const std::vector<StampedPose>& poses, std::int64_t stamp_ns);

// Rotation vector (axis times angle, rad, angle in [0, pi]); exact also for very small angles.
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation);

}  // namespace panvo::evaluation
