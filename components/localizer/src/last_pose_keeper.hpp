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

/// Goes on from the pose that a former process left, and leaves one for the next.
class LastPoseKeeper {
 public:
  /// `is_again`: there was a former process, and it crashed. `log` must outlive it.
  LastPoseKeeper(const ComponentParameters& parameters, bool is_again, const runtime::Logger& log)
      : parameters_(parameters), is_again_(is_again), log_(log) {}

  /// The journey begins at a stamp: its start is where the last pose says. After a crash of which no pose is left that is fresh enough,
  /// the start is not known.
  void begin(Localizer& localizer, std::int64_t stamp_ns) const;

  /// From second to second, while it is known where the vehicle is.
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
