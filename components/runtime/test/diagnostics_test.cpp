// SPDX-License-Identifier: Apache-2.0
#include "diagnostics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "idle_bridge.hpp"
#include "process_use.hpp"
#include "service_totals.hpp"

namespace panvo::runtime {
namespace {

using testing::HasSubstr;

/// A component with one input, in replay, driven by the test.
struct Diagnosed : testing::Test {
  PassingTime time{PassingTime::Pace::kTasks, [] { return 0; }};
  ReplayOrder order{time};
  Bus bus{nullptr, [](const std::string&) {}, [] { return 0; }};
  Host host{.bus = bus,
            .replay_order = &order,
            .time = time,
            .log = [](LogLevel, const std::string&, const std::string&) {},
            .seed = 1,
            .progressed = [] {}};
  Context::State state{host, description(), nullptr};
  Diagnostics diagnostics;

  static ComponentDescription description() {
    ComponentDescription description;
    description.name = "rectifier";
    description.name_space = "/";
    return description;
  }

  diagnostic_msgs::msg::DiagnosticStatus collect(double interval_s) {
    const auto array = diagnostics.collect({&state}, 5'000'000'007, interval_s);
    EXPECT_EQ(array.header().stamp().sec(), 5);
    EXPECT_EQ(array.header().stamp().nanosec(), 7U);
    return array.status().at(0);
  }

  static std::string value(const diagnostic_msgs::msg::DiagnosticStatus& status, const std::string& key) {
    for (const auto& entry : status.values()) {
      if (entry.key() == key) return entry.value();
    }
    return "no such key";
  }

  void handle(Port& port, int count) {
    for (int i = 0; i < count; ++i) state.main_worker().push(port, {});
    while (order.run_one()) {
    }
  }
};

TEST_F(Diagnosed, TellsTheRateSinceTheLastTimeAndTheCountsSinceTheStart) {
  Port& port = state.main_worker().add_port("image", 5, false, [](Task&) {});
  handle(port, 10);
  EXPECT_EQ(value(collect(2.0), "image rate"), "5.0 Hz");
  handle(port, 5);
  const auto status = collect(1.0);
  EXPECT_EQ(status.name(), "panvo: rectifier");
  EXPECT_EQ(status.level(), 0);
  EXPECT_EQ(value(status, "image rate"), "5.0 Hz");
  EXPECT_THAT(value(status, "image messages"), HasSubstr("15 received, 15 handled, 0 dropped, 0 waiting"));
  EXPECT_THAT(value(status, "image time"), HasSubstr("CPU mean"));
}

TEST_F(Diagnosed, TellsTheCpuTimeOfMessagesSinceTheLastTime) {
  state.main_worker().add_port("image", 5, false, [](Task&) {});
  state.times.add("image", 40'000'000, 30'000'000);
  state.times.add("detect", 30'000'000, 20'000'000);  // a part of it
  EXPECT_EQ(value(collect(0.5), "CPU"), "6.0 %");
  state.times.add("image", 40'000'000, 30'000'000);
  EXPECT_EQ(value(collect(2.0), "CPU"), "1.5 %");
}

TEST(ProcessUse, TellsTheCpuTimeSinceTheLastTimeAndTheMemory) {
  ProcessUse use;
  use.status("panvo", 1'000'000'000, 1.0);
  const auto status = use.status("panvo", 1'500'000'000, 2.0);
  EXPECT_EQ(status.name(), "panvo: process of panvo");
  ASSERT_EQ(status.values().size(), 2U);
  EXPECT_EQ(status.values()[0].value(), "25.0 %");
  EXPECT_GT(std::stod(status.values()[1].value()), 1.0);
  EXPECT_THAT(status.values()[1].value(), HasSubstr(" MB"));
}

TEST_F(Diagnosed, WarnsWhileMessagesAreDroppedAndNoLonger) {
  Port& port = state.main_worker().add_port("image", 5, false, [](Task&) {});
  state.main_worker().count_dropped(port);
  EXPECT_EQ(collect(1.0).level(), 1);
  EXPECT_EQ(collect(1.0).level(), 0);
}

/// A bridge that delivers nothing and reports `overwritten` overwritten messages.
class OverwritingBridge final : public IdleBridge {
 public:
  explicit OverwritingBridge(const std::uint64_t& overwritten, std::uint64_t too_large = 0, std::uint64_t too_fast = 0)
      : overwritten_(overwritten), too_large_(too_large), too_fast_(too_fast) {}

  std::unique_ptr<BridgeReader> open_reader(const TopicDescription&, std::function<void(SamplePtr)>) override {
    return std::make_unique<Reader>(*this);
  }

 private:
  struct Reader final : BridgeReader {
    explicit Reader(const OverwritingBridge& bridge) : bridge_(bridge) {}
    std::size_t matched_writers() const override { return 1; }
    BridgeReaderCounters counters() const override {
      return {.overwritten = bridge_.overwritten_, .too_large = bridge_.too_large_, .too_fast = bridge_.too_fast_};
    }
    const OverwritingBridge& bridge_;
  };
  const std::uint64_t& overwritten_;
  const std::uint64_t too_large_, too_fast_;
};

TEST_F(Diagnosed, CountsWhatWasOverwrittenInSharedMemoryAsDropped) {
  std::uint64_t overwritten = 0;
  Bus shared{std::make_unique<OverwritingBridge>(overwritten), [](const std::string&) {}, [] { return 0; }};
  Channel& channel = shared.channel({"/image", "sensor_msgs/msg/Image", {}});
  channel.add_reader(&state, [](const TopicDescription&, const SamplePtr&) {});
  state.inputs.push_back(&channel);
  EXPECT_EQ(value(collect(1.0), "/image overwritten"), "no such key");
  overwritten = 3;
  const auto status = collect(1.0);
  EXPECT_EQ(status.level(), 1);
  EXPECT_EQ(status.message(), "too slow: 3 messages dropped in the last 1 s");
  EXPECT_EQ(value(status, "/image overwritten"), "3 messages, in shared memory while being read");
  EXPECT_EQ(collect(1.0).level(), 0);
  state.stop();  // leaves the channel, which is destroyed first
}

TEST_F(Diagnosed, NamesWhatCouldNotBeUsedAndWhyAndWarnsWhileThatGoesOn) {
  EXPECT_TRUE(state.rejections.add("image", "is cut off"));
  EXPECT_FALSE(state.rejections.add("image", "is cut off"));
  auto status = collect(1.0);
  EXPECT_EQ(status.level(), 1);
  EXPECT_EQ(status.message(), "2 messages could not be used in the last 1 s: image is cut off");
  EXPECT_EQ(value(status, "image rejected"), "2 messages; the last is cut off");

  status = collect(1.0);
  EXPECT_EQ(status.level(), 0);
  EXPECT_EQ(value(status, "image rejected"), "2 messages; the last is cut off");
  EXPECT_TRUE(state.rejections.add("image", "is empty")) << "another reason is worth a line";
}

TEST_F(Diagnosed, NamesWhatWasInvalidBeforeItCameToItBySenderAndReason) {
  Channel& channel =
      bus.channel({"/odometry", "nav_msgs/msg/Odometry", {}, &interfaces::message_type<nav_msgs::msg::Odometry>()});
  channel.add_reader(&state, [](const TopicDescription&, const SamplePtr&) {});
  state.inputs.push_back(&channel);
  nav_msgs::msg::Odometry far;
  far.pose().pose().position().x(1e200);
  channel.publish(Sample::of(*channel.topic().type, std::make_shared<const nav_msgs::msg::Odometry>(far), 0, nullptr,
                             std::make_shared<const std::string>("wheels")));
  const auto status = collect(1.0);
  EXPECT_EQ(status.level(), 1);
  EXPECT_EQ(status.message(),
            "1 messages could not be used in the last 1 s: /odometry pose.pose.position is beyond +-1e+08");
  EXPECT_EQ(value(status, "/odometry rejected from wheels"), "1 messages: pose.pose.position is beyond +-1e+08");
  EXPECT_EQ(collect(1.0).level(), 0);
}

TEST_F(Diagnosed, CountsWhatWasRefusedForItsSizeOrNumber) {
  std::uint64_t overwritten = 0;
  Bus flooded{std::make_unique<OverwritingBridge>(overwritten, 2, 30), [](const std::string&) {}, [] { return 0; }};
  Channel& channel = flooded.channel({"/image", "sensor_msgs/msg/Image", {}});
  channel.add_reader(&state, [](const TopicDescription&, const SamplePtr&) {});
  state.inputs.push_back(&channel);
  const auto status = collect(1.0);
  EXPECT_EQ(status.level(), 1);
  EXPECT_EQ(value(status, "/image refused"), "2 larger than max_message_mb, 30 beyond max_topic_rate_hz");
  EXPECT_EQ(collect(1.0).level(), 0);
  state.stop();
}

TEST_F(Diagnosed, IsInErrorOnceItHasStopped) {
  Port& port = state.main_worker().add_port("image", 5, false, [](Task&) { throw std::logic_error("broken"); });
  handle(port, 1);
  EXPECT_EQ(collect(1.0).level(), 2);
}

TEST_F(Diagnosed, TellsThatItsOwnValuesCannotBeHad) {
  state.diagnose = []() -> DiagnosticValues { throw std::runtime_error("the camera is silent"); };
  const auto status = collect(1.0);
  EXPECT_EQ(value(status, "own values"), "not available: the camera is silent");
  EXPECT_EQ(status.level(), 0);
}

TEST_F(Diagnosed, CountsAnewWhenAComponentHasTakenAnothersPlace) {
  handle(state.main_worker().add_port("image", 5, false, [](Task&) {}), 10);
  collect(1.0);
  Context::State successor{host, description(), nullptr};
  successor.restarts = 1;
  successor.main_worker().add_port("image", 5, false, [](Task&) {});
  const auto status = diagnostics.collect({&successor}, 0, 1.0).status().at(0);
  EXPECT_EQ(status.level(), 0) << status.message();
  EXPECT_EQ(value(status, "image rate"), "0.0 Hz");
  EXPECT_EQ(value(status, "restarted"), "1 times, after an error");
}

struct CountedService final : BridgeService {
  explicit CountedService(const ServiceCounters& all) : all_(all) {}
  ServiceCounters counters() const override { return all_; }
  const ServiceCounters& all_;
};

TEST(ServiceTotals, WarnsOfRequestsThatWereRefusedOrDroppedSinceTheLastTime) {
  ServiceCounters counters{.received = 5, .answered = 3, .dropped = 1, .refused = 1};
  std::vector<std::unique_ptr<BridgeService>> services;
  services.push_back(std::make_unique<CountedService>(counters));
  ServiceTotals totals;
  totals.add(services);
  const auto status = totals.status("panvo", 1.0);
  EXPECT_EQ(status.name(), "panvo: requests to panvo");
  EXPECT_EQ(status.level(), 1);
  EXPECT_THAT(status.values().at(0).value(), HasSubstr("5 received, 3 answered, 1 refused, 1 dropped"));
  totals.add(services);
  EXPECT_EQ(totals.status("panvo", 1.0).level(), 0);
}

}  // namespace
}  // namespace panvo::runtime
