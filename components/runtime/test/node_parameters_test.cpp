// SPDX-License-Identifier: Apache-2.0
// Parameters that every node has: use_sim_time and qos_overrides.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>

#include "context_state.hpp"
#include "panvo/interfaces/node_topics.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/testing.hpp"
#include "std_msgs/msg/String.h"

namespace panvo::runtime {
namespace {

using std_msgs::msg::String;
using testing::AllOf;
using testing::HasSubstr;

constexpr interfaces::Topic<String> kText{"text", {.depth = 3}};
constexpr std::int64_t kSimulated_ns = 5'000'000'000;

/// Reads and publishes a topic; its timer records the stamps of its ticks.
struct Ticking : Component {
  explicit Ticking(Context& context) : output(context.output(kText)), state(&context.state()) {
    last = this;
    context.every(std::chrono::milliseconds(1), [this, &context] {
      const std::lock_guard lock(mutex);
      stamp_ns = context.now_ns();
      changed.notify_all();
    });
  }
  bool reaches(const std::function<bool(std::int64_t)>& wanted) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, std::chrono::seconds(30), [&] { return stamp_ns && wanted(*stamp_ns); });
  }
  Output<String> output;
  Context::State* state;
  std::mutex mutex;
  std::condition_variable changed;
  std::optional<std::int64_t> stamp_ns;
  static inline Ticking* last = nullptr;
};

WrittenValues value(const std::string& name, const std::string& text) { return {{name, {{text}, false, {}}}}; }

ParameterDescription parameter_named(const std::string& name) {
  for (auto& one : Ticking::last->state->parameters()) {
    if (one.name == name) return one;
  }
  return {};
}

rosgraph_msgs::msg::Clock clock_at(std::int64_t stamp_ns) {
  rosgraph_msgs::msg::Clock clock;
  clock.clock().sec(static_cast<std::int32_t>(stamp_ns / 1'000'000'000));
  return clock;
}

TEST(NodeParameters, UseSimTimeMakesTimersTakeTheTimeOfClock) {
  ComponentHarness harness(ContainerOptions{.replay = false});
  harness.add<Ticking>("ticking", {{"use_sim_time", "true"}});
  harness.container().start();
  EXPECT_TRUE(Ticking::last->reaches([](std::int64_t stamp_ns) { return stamp_ns == 0; }));
  harness.publish(topics::kClock, clock_at(kSimulated_ns));
  EXPECT_TRUE(Ticking::last->reaches([](std::int64_t stamp_ns) { return stamp_ns == kSimulated_ns; }));
}

TEST(NodeParameters, UseSimTimeCanBeSetAtRunTime) {
  ComponentHarness harness(ContainerOptions{.replay = false});
  harness.add<Ticking>("ticking");
  harness.container().start();
  const auto is_host_time = [](std::int64_t stamp_ns) { return stamp_ns > 1'000'000'000'000'000'000; };
  EXPECT_TRUE(Ticking::last->reaches(is_host_time));
  EXPECT_EQ(parameter_named("use_sim_time").value, "false");
  EXPECT_TRUE(parameter_named("use_sim_time").settable);
  EXPECT_THAT(Ticking::last->state->set_parameters(value("use_sim_time", "true")), testing::IsEmpty());
  EXPECT_EQ(parameter_named("use_sim_time").value, "true");
  harness.publish(topics::kClock, clock_at(kSimulated_ns));
  EXPECT_TRUE(Ticking::last->reaches([](std::int64_t stamp_ns) { return stamp_ns == kSimulated_ns; }));
  EXPECT_THAT(Ticking::last->state->set_parameters(value("use_sim_time", "false")), testing::IsEmpty());
  EXPECT_TRUE(Ticking::last->reaches(is_host_time));
  EXPECT_THAT(Ticking::last->state->set_parameters(value("use_sim_time", "5")),
              testing::ElementsAre(HasSubstr("use_sim_time")));
}

TEST(NodeParameters, OfAReplayAreAcceptedAndIgnoreTheClock) {
  ComponentHarness harness;
  harness.add<Ticking>("ticking", {{"use_sim_time", "true"}});
  EXPECT_EQ(parameter_named("use_sim_time").value, "true");
  EXPECT_FALSE(Ticking::last->state->follows_clock());
}

TEST(NodeParameters, QosOverridesAreDeclaredReadOnlyWithTheValuesInUse) {
  ComponentHarness harness;
  harness.add<Ticking>("ticking", {{"qos_overrides./text.publisher.depth", "7"}});
  EXPECT_EQ(parameter_named("qos_overrides./text.publisher.depth").value, "7");
  EXPECT_EQ(parameter_named("qos_overrides./text.publisher.depth").default_value, "3");
  EXPECT_EQ(parameter_named("qos_overrides./text.publisher.reliability").value, "reliable");
  EXPECT_EQ(parameter_named("qos_overrides./text.publisher.durability").value, "volatile");
  EXPECT_EQ(parameter_named("qos_overrides./text.publisher.history").value, "keep_last");
  EXPECT_THAT(Ticking::last->state->set_parameters(value("qos_overrides./text.publisher.depth", "9")),
              testing::ElementsAre(HasSubstr("read-only")));
}

TEST(NodeParameters, QosOverridesOfADepthHoldForTheQueue) {
  struct Slow : Component {
    explicit Slow(Context& context) {
      context.input(kText, [this](const auto&) { ++seen; });
      last() = this;
    }
    static Slow*& last() {
      static Slow* slow = nullptr;
      return slow;
    }
    std::atomic<int> seen = 0;
  };
  ComponentHarness harness(ContainerOptions{.replay = false});
  harness.add<Slow>("slow", {{"qos_overrides./text.subscription.depth", "2"}});
  for (int i = 0; i < 5; ++i) harness.publish(kText, String());  // it has not started: they wait
  harness.container().start();
  const auto counters = harness.container().queue_counters();
  ASSERT_EQ(counters.size(), 1U);
  EXPECT_EQ(counters[0].received, 5U);
  EXPECT_EQ(counters[0].dropped, 3U);
}

TEST(NodeParameters, QosOverridesWithATypingErrorAreRefused) {
  ComponentHarness harness;
  const auto problem = [&](const std::string& name, const std::string& text) -> std::string {
    try {
      harness.add<Ticking>("ticking", {{name, text}});
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(problem("qos_overrides./text.publisher.reliability", "besteffort"),
              HasSubstr("must be one of reliable, best_effort"));
  EXPECT_THAT(problem("qos_overrides./text.publisher.dept", "5"),
              AllOf(HasSubstr("no parameter"), HasSubstr("qos_overrides./text.publisher.depth")));
  EXPECT_THAT(problem("qos_overrides./other.publisher.depth", "5"), HasSubstr("no parameter"));
}

TEST(NodeParameters, QosOverridesOfTwoPublishersOfOneTopicMustAgree) {
  ComponentHarness harness;
  harness.add<Ticking>("one", {{"qos_overrides./text.publisher.reliability", "best_effort"}});
  EXPECT_NO_THROW(harness.add<Ticking>("two", {{"qos_overrides./text.publisher.reliability", "best_effort"}}));
  EXPECT_THROW(harness.add<Ticking>("three"), ConfigError);
}

TEST(NodeParameters, QosOverridesOfVolatileLeaveOutEarlierMessages) {
  static constexpr interfaces::Topic<String> kLatched{"latched", interfaces::qos::kLatched};
  struct Late : Component {
    explicit Late(Context& context) {
      context.input(kLatched, [](const auto&) { ++seen(); });
    }
    static int& seen() {
      static int count = 0;
      return count;
    }
  };
  ComponentHarness harness;
  harness.publish(kLatched, String());
  harness.add<Late>("late", {{"qos_overrides./latched.subscription.durability", "volatile"}});
  harness.container().run_until_quiet();
  EXPECT_EQ(Late::seen(), 0);
  harness.publish(kLatched, String());
  EXPECT_EQ(Late::seen(), 1);
}

}  // namespace
}  // namespace panvo::runtime
