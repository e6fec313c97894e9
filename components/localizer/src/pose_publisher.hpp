// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>

#include "component_parameters.hpp"
#include "nav_msgs/msg/Odometry.h"
#include "panvo/localizer/localizer.hpp"
#include "panvo/runtime/context.hpp"
#include "panvo_msgs/msg/Integrity.h"
#include "panvo_msgs/msg/LocalizationState.h"
#include "tf2_msgs/msg/TFMessage.h"

namespace panvo::localizer {

/// Publishes pose, frames and integrity when there is news, and the state on change and periodically, so that an
/// outdated one is recognised.
class PosePublisher {
 public:
  /// Both must outlive it.
  PosePublisher(runtime::Context& context, const ComponentParameters& parameters);

  /// Publishes the latest pose. As subscribers treat two poses of one stamp as the same, updates between two odometry
  /// messages are stamped one nanosecond after the last pose; they do not end the state stale.
  void publish_pose(const Localizer& localizer, const nav_msgs::msg::Odometry& stereo, bool is_of_new_odometry);

  /// Whether the pose has changed so much since it was published that it should not wait for the next odometry.
  bool is_notable(const LocalizedPose& now) const;

  /// To be called ten times a second. `silence_s`: time since the last odometry. `now_ns`: stamp to use before any
  /// odometry.
  void tick(const Localizer& localizer, double silence_s, std::int64_t now_ns);

  /// To be called after a clock change: the next pose may have an earlier stamp.
  void forget_stamps() { published_stamp_ns_.reset(); }

 private:
  void publish_state(const LocalizedPose& pose, std::int64_t since_ns);
  void publish_integrity(const LocalizedPose& pose, const Localizer& localizer);

  const std::string odometry_topic_;  // as remapped
  const runtime::Logger& log_;
  const ComponentParameters& parameters_;
  runtime::Output<nav_msgs::msg::Odometry> enhanced_;
  runtime::Output<tf2_msgs::msg::TFMessage> tf_;
  runtime::Output<panvo_msgs::msg::LocalizationState> state_;
  runtime::Output<panvo_msgs::msg::Integrity> integrity_;

  std::optional<State> published_state_;
  std::int64_t state_since_ns_ = 0;
  int ticks_since_state_ = 0;
  std::optional<std::int64_t> published_stamp_ns_;
  Eigen::Isometry3d published_map_from_base_ = Eigen::Isometry3d::Identity();
};

}  // namespace panvo::localizer
