// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "disparity_offset.hpp"
#include "panvo/binocular_odometry/parameters.hpp"
#include "track.hpp"

namespace panvo::binocular_odometry {

/// Observations of the tracks in two frames, of those with a disparity in the first. Both lists ascend by id; tracks
/// that are in one list only are left out.
std::vector<FramePair> seen_twice(std::span<const Track> before, std::span<const Track> now);

/// Motion current_from_previous that the points agree on, found by RANSAC; used only to predict where features are.
/// `expected`: predicted motion, tried first. nullopt if too few points agree.
std::optional<Eigen::Isometry3d> coarse_motion(const vision::RectifiedStereo& stereo, std::span<const FramePair> points,
                                               const DisparityOffset& offset, const Eigen::Isometry3d& expected,
                                               const MotionParameters& parameters);

}  // namespace panvo::binocular_odometry
