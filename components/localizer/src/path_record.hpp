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

/// A path for display: a pose every few metres, published every few seconds. When it exceeds `max_poses`, every second
/// pose is removed and the spacing doubled, so that a whole day fits into a message.
class PathRecord {
 public:
  PathRecord(double step_m, double period_s, std::size_t max_poses = 4000)
      : step_m_(step_m), period_s_(period_s), max_poses_(max_poses) {}

  /// Returns whether the path is due to be published.
  bool add(std::int64_t stamp_ns, const Eigen::Isometry3d& frame_from_base);

  nav_msgs::msg::Path message(const std::string& frame) const;

 private:
  struct Pose {
    std::int64_t stamp_ns;
    Eigen::Isometry3d frame_from_base;
  };

  double step_m_;
  const double period_s_;
  const std::size_t max_poses_;
  std::vector<Pose> poses_;
  std::optional<std::int64_t> published_ns_;
};

}  // namespace panvo::localizer
