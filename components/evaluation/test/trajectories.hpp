// SPDX-License-Identifier: Apache-2.0
// Small trajectories with known properties.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "panvo/evaluation/association.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/trajectory.hpp"

namespace panvo::evaluation {

inline Eigen::Isometry3d make_pose(double x, double y, double z, double yaw = 0.0, double pitch = 0.0,
                                   double roll = 0.0) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

// `count` poses 0.1 s and 1 m apart along x.
inline Trajectory straight_line(std::size_t count, double step_m = 1.0) {
  Trajectory line{{}, "line", "test"};
  for (std::size_t i = 0; i < count; ++i) {
    line.poses.push_back(
        {static_cast<std::int64_t>(i) * 100'000'000, make_pose(step_m * static_cast<double>(i), 0, 0)});
  }
  return line;
}

// A path that turns about all axes, so that the alignment is fully determined.
inline Trajectory winding_path(std::size_t count) {
  Trajectory path{{}, "winding", "test"};
  for (std::size_t i = 0; i < count; ++i) {
    const double t = 0.05 * static_cast<double>(i);
    path.poses.push_back({static_cast<std::int64_t>(i) * 50'000'000,
                          make_pose(10.0 * t, 8.0 * std::sin(t), 2.0 * std::cos(1.3 * t), std::cos(t), 0.1 * t, 0.2)});
  }
  return path;
}

inline Trajectory transformed(Trajectory trajectory, const Eigen::Isometry3d& new_from_old, double scale = 1.0) {
  for (StampedPose& pose : trajectory.poses) {
    pose.world_from_base.translation() *= scale;
    pose.world_from_base = new_from_old * pose.world_from_base;
  }
  return trajectory;
}

inline std::vector<PosePair> pairs_of(const Trajectory& estimate, const Trajectory& ground_truth) {
  return associate(estimate, ground_truth).pairs;
}

// Message of the InputError thrown by `action`; empty if there was none.
template <class Action>
std::string input_error_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace panvo::evaluation
