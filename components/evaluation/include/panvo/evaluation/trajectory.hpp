// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace panvo::evaluation {

// Where the base was at a time. `world` is the odom or map frame of an estimate, or the frame of the ground truth.
struct StampedPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d world_from_base = Eigen::Isometry3d::Identity();
};

// Poses in strictly increasing order of stamp, all finite: the readers see to both.
struct Trajectory {
  std::vector<StampedPose> poses;
  std::filesystem::path source;  // file it was read from; empty for one made in memory
  std::string format;            // "TUM", "EuRoC", "KITTI ...": what the reader took it for, for people
};

// Length of the polyline through the positions, m.
double path_length_m(const Trajectory& trajectory);

// Median time from one pose to the next, ns; 0 with fewer than two poses.
std::int64_t median_period_ns(const Trajectory& trajectory);

// The pose at `stamp_ns` between two poses: position on the straight line, orientation by spherical interpolation.
// Requires before.stamp_ns < after.stamp_ns.
Eigen::Isometry3d interpolate(const StampedPose& before, const StampedPose& after, std::int64_t stamp_ns);

// Rotation vector (axis times angle, rad, angle in [0, pi]); exact also for very small angles.
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation);

}  // namespace panvo::evaluation
