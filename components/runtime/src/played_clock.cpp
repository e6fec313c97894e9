// SPDX-License-Identifier: Apache-2.0
#include "played_clock.hpp"

#include "panvo/interfaces/node_topics.hpp"

namespace panvo::runtime {

TopicDescription PlayedClock::topic() {
  const auto& type = interfaces::message_type<rosgraph_msgs::msg::Clock>();
  return {std::string(topics::kClock.name), std::string(type.name), topics::kClock.qos, &type};
}

void PlayedClock::reach(std::int64_t stamp_ns) {
  std::int64_t last_ns = reached_ns_;
  if (stamp_ns <= last_ns || !reached_ns_.compare_exchange_strong(last_ns, stamp_ns)) return;
  constexpr std::int64_t kSecond = 1'000'000'000;
  auto clock = std::make_shared<rosgraph_msgs::msg::Clock>();
  clock->clock().sec(static_cast<std::int32_t>(stamp_ns / kSecond));
  clock->clock().nanosec(static_cast<std::uint32_t>(stamp_ns % kSecond));
  writer_->write(Sample::of(interfaces::message_type<rosgraph_msgs::msg::Clock>(), std::move(clock), stamp_ns));
}

}  // namespace panvo::runtime
