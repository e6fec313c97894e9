// SPDX-License-Identifier: Apache-2.0
// Invalid messages are detected before delivery.
#include "message_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "bus.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"

namespace panvo::runtime {
namespace {

using nav_msgs::msg::Odometry;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t kAnySize = std::numeric_limits<std::size_t>::max();

Odometry odometry(double x) {
  Odometry message;
  message.pose().pose().position().x(x);
  return message;
}

Odometry with_a_nan() {
  auto message = odometry(1.0);
  message.pose().covariance()[21] = std::numeric_limits<double>::quiet_NaN();
  return message;
}

interfaces::Bytes bytes_of(const Odometry& message) {
  const auto& type = interfaces::message_type<Odometry>();
  interfaces::Bytes bytes(type.serialized_size(&message));
  type.serialize(&message, bytes);
  return bytes;
}

SamplePtr from_bytes(interfaces::Bytes bytes) {
  const auto& type = interfaces::message_type<Odometry>();
  return Sample::from_bytes(&type, std::string(type.name), std::move(bytes), 0,
                            std::make_shared<const std::string>("player"));
}

/// Records received positions and publishes messages on request.
struct Listener : Component {
  Listener(Context& context, std::vector<double>& seen) {
    context.input(topics::kOdometryBinocular, [&seen](std::shared_ptr<const Odometry> message) {
      seen.push_back(message->pose().pose().position().x());
    });
  }
};

struct Recording : Component {
  Recording(Context& context, std::vector<std::size_t>& sizes) {
    context.tap(
        [](const TopicDescription& topic) { return topic.name == "/odometry/binocular"; }, 10,
        [&sizes](const TopicDescription&, const SamplePtr& sample) { sizes.push_back(sample->bytes().size()); });
  }
};

ComponentDescription probe_named(const std::string& name) {
  ComponentDescription description;
  description.name = name;
  description.package = "panvo_" + name;
  description.name_space = "/";
  return description;
}

struct Gate : testing::Test {
  void listen() {
    harness.container().add(probe_named("listener"),
                            [this](Context& context) { return std::make_unique<Listener>(context, seen); });
  }
  long lines_of(const std::string& text) const {
    return std::ranges::count_if(harness.log(), [&](const auto& line) { return line.find(text) != std::string::npos; });
  }

  ComponentHarness harness;
  std::vector<double> seen;
};

TEST_F(Gate, LeavesOutWhatBreaksTheRulesOfItsTypeAndSaysFromWhom) {
  listen();
  harness.publish(topics::kOdometryBinocular, odometry(1.0));
  harness.publish(topics::kOdometryBinocular, with_a_nan());
  harness.publish(topics::kOdometryBinocular, odometry(1e200));
  harness.publish(topics::kOdometryBinocular, odometry(2.0));
  EXPECT_THAT(seen, ElementsAre(1.0, 2.0));
  EXPECT_TRUE(
      harness.log_contains("warning container: /odometry/binocular: a message from test_publisher_1 was dropped: "
                           "pose.covariance is not finite"));
  EXPECT_TRUE(harness.log_contains("was dropped: pose.pose.position is beyond +-1e+08"));
}

TEST_F(Gate, SaysTheSameOnceHoweverOftenItHappens) {
  listen();
  for (int i = 0; i < 100; ++i) {
    harness.publish(topics::kOdometryBinocular, with_a_nan());
    harness.publish(topics::kOdometryBinocular, odometry(1e200));
  }
  EXPECT_THAT(seen, IsEmpty());
  EXPECT_EQ(lines_of("pose.covariance is not finite"), 1);
  EXPECT_EQ(lines_of("pose.pose.position is beyond"), 1);
}

TEST_F(Gate, LetsNothingInvalidOutOfTheProcess) {
  const auto& observed = harness.collect(topics::kOdometryBinocular);
  harness.publish(topics::kOdometryBinocular, with_a_nan());
  EXPECT_THAT(observed, IsEmpty()) << "nobody here listens, but somebody outside may";
}

TEST_F(Gate, ShowsRecordersAllThatIsSent) {
  std::vector<std::size_t> recorded;
  listen();
  harness.container().add(probe_named("recorder"),
                          [&](Context& context) { return std::make_unique<Recording>(context, recorded); });
  harness.publish(topics::kOdometryBinocular, with_a_nan());
  harness.publish(topics::kOdometryBinocular, odometry(1.0));
  EXPECT_EQ(recorded.size(), 2U);
  EXPECT_THAT(seen, ElementsAre(1.0));
}

TEST(MessageGate, FindsBytesThatAreNoMessage) {
  auto bytes = bytes_of(odometry(1.0));
  EXPECT_EQ(problem_of(*from_bytes(bytes), kAnySize), std::nullopt);
  bytes.resize(bytes.size() / 2);
  EXPECT_THAT(problem_of(*from_bytes(bytes), kAnySize).value_or(""), HasSubstr("nav_msgs/msg/Odometry: truncated"));
}

TEST(MessageGate, FindsWhatIsTooLargeBeforeItIsDecoded) {
  auto bytes = bytes_of(odometry(1.0));
  EXPECT_EQ(problem_of(*from_bytes(bytes), bytes.size()), std::nullopt);
  bytes[0] = 0xFF;  // not a message
  EXPECT_EQ(problem_of(*from_bytes(bytes), 500), "is larger than 0.0005 MB (max_message_mb)");
}

TEST(MessageGate, TakesTypesWithoutRulesAsTheyAre) {
  std_msgs::msg::Header header;
  header.stamp().nanosec(2'000'000'000);
  const auto& type = interfaces::message_type<std_msgs::msg::Header>();
  EXPECT_EQ(type.problem, nullptr);
  EXPECT_EQ(problem_of(*Sample::of(type, std::make_shared<const std_msgs::msg::Header>(header), 0), kAnySize),
            std::nullopt);
}

TEST(ChannelGate, CountsBySenderAndReason) {
  Channel channel(
      {"/odometry", "nav_msgs/msg/Odometry", {}, &interfaces::message_type<Odometry>()}, nullptr,
      [](const std::string&) {}, [] { return 0; });
  int seen = 0;
  channel.add_reader(&seen, [&](const TopicDescription&, const SamplePtr&) { ++seen; });
  channel.publish(from_bytes(bytes_of(with_a_nan())));
  channel.publish(from_bytes(bytes_of(with_a_nan())));
  channel.publish(from_bytes(bytes_of(odometry(1e200))));
  channel.publish(from_bytes(bytes_of(odometry(1.0))));
  const auto rejected = channel.rejected();
  EXPECT_EQ(seen, 1);
  EXPECT_EQ(rejected.messages, 3U);
  EXPECT_THAT(
      rejected.causes,
      ElementsAre(testing::Pair(RejectedMessages::Cause("player", "pose.covariance is not finite"), 2U),
                  testing::Pair(RejectedMessages::Cause("player", "pose.pose.position is beyond +-1e+08"), 1U)));
}

TEST(ChannelGate, LeavesBytesThatNobodyHereReadsAsTheyAre) {
  Channel channel(
      {"/odometry", "nav_msgs/msg/Odometry", {}, &interfaces::message_type<Odometry>()}, nullptr,
      [](const std::string&) {}, [] { return 0; });
  channel.publish(from_bytes({0, 1, 0, 0, 9}));
  EXPECT_EQ(channel.rejected().messages, 0U);
}

TEST(ChannelGate, ChecksWhatALateReaderGetsToo) {
  Channel channel(
      {"/odometry", "nav_msgs/msg/Odometry", interfaces::qos::kLatched, &interfaces::message_type<Odometry>()}, nullptr,
      [](const std::string&) {}, [] { return 0; });
  channel.publish(from_bytes(bytes_of(with_a_nan())));
  channel.publish(from_bytes(bytes_of(odometry(1.0))));
  int seen = 0;
  channel.add_reader(&seen, [&](const TopicDescription&, const SamplePtr&) { ++seen; });
  EXPECT_EQ(seen, 1);
}

TEST(RejectedMessages, DoNotGrowWithEverNewReasons) {
  RejectedMessages rejections;
  for (int i = 0; i < 1000; ++i) rejections.add("/topic", "reason " + std::to_string(i), "sender");
  const auto count = rejections.snapshot().at("/topic");
  EXPECT_EQ(count.messages, 1000U);
  EXPECT_EQ(count.causes.size(), RejectedMessages::kMaxCauses + 1);
}

}  // namespace
}  // namespace panvo::runtime
