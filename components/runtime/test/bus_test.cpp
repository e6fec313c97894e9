// SPDX-License-Identifier: Apache-2.0
#include "bus.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "panvo/interfaces/topics.hpp"

namespace panvo::runtime {
namespace {

using panvo_msgs::msg::LocalizationState;

TopicDescription state_topic() {
  const auto& type = interfaces::message_type<LocalizationState>();
  return {"/localization/state", std::string(type.name), topics::kLocalizationState.qos, &type};
}

struct LatchedState : testing::Test {
  std::int64_t now_ns = 0;
  Channel channel{state_topic(), nullptr, [](const std::string&) {}, [this] { return now_ns; }};
  int publisher = 0;
  int late = 0;

  LatchedState() {
    channel.add_publisher(&publisher, "localizer");
    LocalizationState state;
    state.state(panvo_msgs::msg::LocalizationState_Constants::TRACKING);
    channel.publish(Sample::of(interfaces::message_type<LocalizationState>(),
                               std::make_shared<const LocalizationState>(state), 0, nullptr));
  }
  /// Number of messages that a late joiner gets.
  int seen_late() {
    int seen = 0;
    channel.add_reader(&late, [&](const TopicDescription&, const SamplePtr&) { ++seen; });
    channel.remove_reader(&late);
    return seen;
  }
};

TEST_F(LatchedState, ReachesWhoComesLate) {
  now_ns = 2'900'000'000;
  EXPECT_EQ(seen_late(), 1);
}

TEST_F(LatchedState, DoesNotOutliveItsNode) {
  channel.remove_publisher(&publisher);
  EXPECT_EQ(seen_late(), 0);
}

TEST_F(LatchedState, GrowsTooOldWhenNobodyConfirmsIt) {
  now_ns = 3'100'000'000;
  EXPECT_EQ(seen_late(), 0);
}

}  // namespace
}  // namespace panvo::runtime
