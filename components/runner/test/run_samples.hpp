// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "nav_msgs/msg/Odometry.h"
#include "panvo/runner/run_files.hpp"

/// Messages, topics and a summary for tests of result files.
namespace panvo::runner {

using nav_msgs::msg::Odometry;

template <class Message>
runtime::TopicDescription topic_of(const std::string& name) {
  const auto& type = interfaces::message_type<Message>();
  return {name, std::string(type.name), {}, &type};
}

template <class Message>
runtime::SamplePtr sample_of(const Message& message) {
  return runtime::Sample::of(interfaces::message_type<Message>(), std::make_shared<const Message>(message), 0);
}

inline runtime::TopicDescription odometry_topic(const std::string& name) { return topic_of<Odometry>(name); }

inline const auto kBinocular = odometry_topic("/odometry/binocular");

inline Odometry odometry_at(std::int32_t sec, std::uint32_t nanosec, double x) {
  Odometry odometry;
  odometry.header().stamp().sec(sec);
  odometry.header().stamp().nanosec(nanosec);
  odometry.pose().pose().position().x(x);
  odometry.pose().pose().orientation().w(1.0);
  odometry.pose().covariance()[7] = 0.25;
  odometry.twist().covariance()[35] = 1e-6;
  odometry.twist().twist().linear().x(2.0);
  return odometry;
}

inline RunSummary summary_of(const std::string& component, double wall_s) {
  RunSummary summary;
  summary.frames_in = 100;
  summary.frames_out = 98;
  summary.frames_unreliable = 7;
  summary.queues = {{component, "/stereo/left/image_rect", 100, 98, 2}};
  summary.cpu_s = 1.5;
  summary.wall_s = wall_s;
  summary.peak_memory_mb = 120.5;
  summary.version = "0.1.0";
  summary.seed = 18446744073709551615U;
  summary.replay = true;
  summary.system_file = "stereo.yaml";
  summary.changed_parameters = {{component, {{"tracker.max_features", "500"}}}};
  summary.problems = {component + " was late"};
  return summary;
}

}  // namespace panvo::runner
