// SPDX-License-Identifier: Apache-2.0
#include "pose_publisher.hpp"
#include "panvo/interfaces/topics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "localizer_messages.hpp"

namespace panvo::localizer {
namespace {

constexpr int kStateTicks = 4;    // the state is published at least twice a second
constexpr double kNotable = 0.5;  // standard deviations

}  // namespace

PosePublisher::PosePublisher(runtime::Context& context, const ComponentParameters& parameters)
    : odometry_topic_(context.resolved_name(topics::kOdometryBinocular)),
      log_(context.log()),
      parameters_(parameters),
      enhanced_(context.output(topics::kOdometryEnhanced)),
      tf_(context.output(topics::kTf)),
      state_(context.output(topics::kLocalizationState)),
      integrity_(context.output(topics::kIntegrity)) {}

void PosePublisher::publish_pose(const Localizer& localizer, const nav_msgs::msg::Odometry& stereo,
                                 bool is_of_new_odometry) {
  auto pose = localizer.latest();
  if (published_stamp_ns_) pose.stamp_ns = std::max(pose.stamp_ns, *published_stamp_ns_ + 1);
  published_stamp_ns_ = pose.stamp_ns;
  published_map_from_base_ = pose.map_from_base;
  enhanced_.publish(to_odometry(pose, stereo, parameters_.map_frame));
  tf_.publish(to_transforms(pose, parameters_.map_frame, parameters_.odom_frame, stereo.child_frame_id()));
  if (published_state_ == State::kStale && !is_of_new_odometry) return;
  publish_integrity(pose, localizer);
  if (published_state_ != pose.state) publish_state(pose, pose.stamp_ns);
}

bool PosePublisher::is_notable(const LocalizedPose& now) const {
  const auto moved = vision::pose_error(published_map_from_base_, now.map_from_base);
  return moved.head<2>().norm() > kNotable * vision::horizontal_sigma(now.covariance) ||
         std::abs(moved(5)) > kNotable * std::sqrt(std::max(now.covariance(5, 5), 0.0));
}

void PosePublisher::tick(const Localizer& localizer, double silence_s, std::int64_t now_ns) {
  const bool is_stale = silence_s > parameters_.stale_after_s;
  auto pose = localizer.after_silence(is_stale ? silence_s : 0.0);
  if (pose.state == State::kStarting) {
    if (now_ns == 0) return;  // playback has not started
    pose.stamp_ns = now_ns;
    pose.reason = fmt::format("no {} yet", odometry_topic_);
  } else if (is_stale) {
    pose.state = State::kStale;
    pose.reason = fmt::format("no {} for {:.1f} s", odometry_topic_, silence_s);
  }
  if (published_state_ == pose.state && ++ticks_since_state_ < kStateTicks) return;
  publish_state(pose, is_stale ? localizer.latest().stamp_ns : pose.stamp_ns);
  publish_integrity(pose, localizer);
}

void PosePublisher::publish_state(const LocalizedPose& pose, std::int64_t since_ns) {
  if (published_state_ != pose.state) {
    state_since_ns_ = since_ns;
    const auto text = fmt::format("{}{}{}", to_text(pose.state), pose.reason.empty() ? "" : ": ", pose.reason);
    if (pose.state == State::kLost || pose.state == State::kCompassOnly || pose.state == State::kStale) {
      log_.warn("{}", text);
    } else {
      log_.info("{}", text);
    }
  }
  published_state_ = pose.state;
  ticks_since_state_ = 0;
  state_.publish(to_state(pose, state_since_ns_, parameters_.map_frame));
}

void PosePublisher::publish_integrity(const LocalizedPose& pose, const Localizer& localizer) {
  integrity_.publish(to_integrity(pose, localizer.doubts(), parameters_.integrity, parameters_.map_frame));
}

}  // namespace panvo::localizer
