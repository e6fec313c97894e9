// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "component_parameters.hpp"
#include "geometry_msgs/msg/Twist.h"
#include "last_pose.hpp"
#include "panvo/localizer/localizer.hpp"
#include "panvo/runtime/logger.hpp"

namespace panvo::localizer {

/// Resumes from the pose that a previous process saved, and saves one for the next process.
class LastPoseKeeper {
 public:
  /// `is_again`: a previous process crashed. `log` must outlive it.
  LastPoseKeeper(const ComponentParameters& parameters, bool is_again, const runtime::Logger& log)
      : parameters_(parameters), is_again_(is_again), log_(log) {}

  /// Starts the journey at a stamp, from the last pose if it is recent enough. After a crash without a recent last
  /// pose, the start is unknown.
  void begin(Localizer& localizer, std::int64_t stamp_ns) const;

  /// Saves the pose every second while the vehicle is localised.
  void keep(const LocalizedPose& pose, const geometry_msgs::msg::Twist& twist);

 private:
  std::optional<LastPose> read() const;
  bool go_on(Localizer& localizer, const LastPose& last, std::int64_t stamp_ns) const;

  const ComponentParameters& parameters_;
  const bool is_again_;
  const runtime::Logger& log_;
  std::optional<std::int64_t> kept_ns_;
};

}  // namespace panvo::localizer
