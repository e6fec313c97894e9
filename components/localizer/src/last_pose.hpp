// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "panvo/localizer/local_pose_graph.hpp"

namespace panvo::localizer {

/// The last known pose, from which a restarted process resumes.
struct LastPose {
  std::int64_t stamp_ns = 0;
  std::string map_frame;
  PoseInMap pose;
  double speed_m_per_s = 0.0;
};

/// The pose after `gap_s` >= 0, with the uncertainty of driving at the last speed and turning in that time.
PoseInMap after_gap(const LastPose& last, double gap_s);

/// As write_kept(). Throws std::runtime_error naming the file also for a pose that read_last_pose would reject.
void write_last_pose(const std::filesystem::path& file, const LastPose& last);

/// As read_kept().
std::optional<LastPose> read_last_pose(const std::filesystem::path& file);

}  // namespace panvo::localizer
