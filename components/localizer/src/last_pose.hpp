// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "panvo/localizer/journey_graph.hpp"

namespace panvo::localizer {

/// Where the vehicle was last: what a process that is started again goes on from.
struct LastPose {
  std::int64_t stamp_ns = 0;
  std::string map_frame;
  PoseInMap pose;
  double speed_m_per_s = 0.0;
};

/// Where it may be by now: as far off as it may have gone at its last speed, or been turned. `gap_s` >= 0.
PoseInMap after_gap(const LastPose& last, double gap_s);

/// Replaces the file as a whole, so that a process that is killed meanwhile leaves the old one. Throws std::runtime_error that names it, for a
/// pose that read_last_pose would refuse, too.
void write_last_pose(const std::filesystem::path& file, const LastPose& last);

/// Nothing where there is no file. Throws std::runtime_error that names the file, what is wrong with it and the remedy.
std::optional<LastPose> read_last_pose(const std::filesystem::path& file);

}  // namespace panvo::localizer
