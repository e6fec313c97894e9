// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nav_msgs/msg/Path.h"

namespace panvo::localizer {

/// A path for people to look at: a pose every so many metres, told every few seconds. When it has grown to `most_poses`, every
/// second pose goes and poses come half as often, so that a day's path fits in a message, too.
class PathRecord {
 public:
  PathRecord(double step_m, double period_s, std::size_t most_poses = 4000)
      : step_m_(step_m), period_s_(period_s), most_poses_(most_poses) {}

  /// True when the path is to be told.
  bool add(std::int64_t stamp_ns, const Eigen::Isometry3d& frame_from_base);

  nav_msgs::msg::Path message(const std::string& frame) const;

 private:
  struct Pose {
    std::int64_t stamp_ns;
    Eigen::Isometry3d frame_from_base;
  };

  double step_m_;
  const double period_s_;
  const std::size_t most_poses_;
  std::vector<Pose> poses_;
  std::optional<std::int64_t> told_ns_;
};

}  // namespace panvo::localizer
