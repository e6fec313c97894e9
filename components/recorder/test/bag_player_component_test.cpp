// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "panvo/interfaces/topics.hpp"
#include "panvo/recorder/bag_copy.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "test_bag.hpp"

namespace panvo::recorder {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;
using runtime::ComponentHarness;
using testing::ElementsAre;
using testing::HasSubstr;

nav_msgs::msg::Odometry odometry(std::int32_t sec) {
  nav_msgs::msg::Odometry message;
  message.header().stamp().sec(sec);
  return message;
}

template <class Message>
interfaces::Bytes bytes_of(const Message& message) {
  const auto& type = interfaces::message_type<Message>();
  interfaces::Bytes bytes(type.serialized_size(&message));
  type.serialize(&message, bytes);
  return bytes;
}

/// Records the arrival order of odometry and transforms, and publishes a topic itself.
class Witness final : public runtime::Component {
 public:
  explicit Witness(runtime::Context& context) : enhanced_(context.output(topics::kOdometryEnhanced)) {
    context.input(topics::kOdometryBinocular, [this](const std::shared_ptr<const nav_msgs::msg::Odometry>& message) {
      seen.push_back("odometry " + std::to_string(message->header().stamp().sec()));
      enhanced_.publish(message);
    });
    context.input(topics::kTf, [](const std::shared_ptr<const tf2_msgs::msg::TFMessage>&) { seen.push_back("tf"); });
  }

  static inline std::vector<std::string> seen;

 private:
  runtime::Output<nav_msgs::msg::Odometry> enhanced_;
};

class BagPlayer : public testing::Test {
 protected:
  void SetUp() override {
    Witness::seen.clear();
    BagWriter writer(bag_);
    const auto add = [&](const char* name, const char* type, const interfaces::Qos& qos) {
      return writer.add_topic(BagTopic::of(name, *interfaces::find_message_type(type), qos));
    };
    const int odometry_topic = add("/odometry/binocular", "nav_msgs/msg/Odometry", interfaces::qos::kResult);
    const int tf = add("/tf", "tf2_msgs/msg/TFMessage", interfaces::qos::kDefault);
    const int enhanced = add("/odometry/enhanced", "nav_msgs/msg/Odometry", interfaces::qos::kResult);
    writer.write(odometry_topic, kStart + 20, bytes_of(odometry(2)));
    writer.write(tf, kStart + 20, bytes_of(tf2_msgs::msg::TFMessage()));
    writer.write(enhanced, kStart + 20, bytes_of(odometry(99)));
    writer.write(odometry_topic, kStart + 10, bytes_of(odometry(1)));
    writer.write(odometry_topic, kStart + 20, bytes_of(odometry(3)));
  }

  std::string refusal(std::map<std::string, std::string> parameters) {
    ComponentHarness harness;
    try {
      harness.load("panvo_recorder", "BagPlayerComponent", parameters);
    } catch (const runtime::ConfigError& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
  const std::filesystem::path bag_ = folder_ / "bag";
};

TEST_F(BagPlayer, PlaysInOrderOfTimeAndAtOneTimeInThatOfTheBag) {
  ComponentHarness harness;
  harness.add<Witness>("witness");
  harness.load("panvo_recorder", "BagPlayerComponent", {{"directory", bag_.string()}});
  EXPECT_THAT(harness.container().run(), testing::IsEmpty());
  EXPECT_THAT(Witness::seen, ElementsAre("odometry 1", "odometry 2", "tf", "odometry 3"));
}

TEST_F(BagPlayer, PlaysMcapAlike) {
  // In chunks of one message.
  copy_bag(bag_, folder_ / "mcap", {},
           {.storage = Storage::kMcap, .compression = Compression::kZstd, .chunk_bytes = 1});
  for (const auto& bag : {folder_ / "mcap", folder_ / "mcap" / "mcap_0.mcap"}) {
    Witness::seen.clear();
    ComponentHarness harness;
    harness.add<Witness>("witness");
    harness.load("panvo_recorder", "BagPlayerComponent", {{"directory", bag.string()}});
    EXPECT_THAT(harness.container().run(), testing::IsEmpty());
    EXPECT_THAT(Witness::seen, ElementsAre("odometry 1", "odometry 2", "tf", "odometry 3"));
  }
}

TEST_F(BagPlayer, DoesNotPlayWhatTheSystemComputesAndSaysSo) {
  ComponentHarness harness;
  const auto& enhanced = harness.collect(topics::kOdometryEnhanced);
  harness.add<Witness>("witness");
  harness.load("panvo_recorder", "BagPlayerComponent", {{"directory", bag_.string()}});
  harness.container().run();
  EXPECT_TRUE(harness.log_contains("not played because this system publishes them itself: /odometry/enhanced"));
  ASSERT_EQ(enhanced.size(), 3u);
  for (const auto& message : enhanced) {
    EXPECT_NE(message->header().stamp().sec(), 99);
  }
}

TEST_F(BagPlayer, PlaysWhatNobodyComputes) {
  ComponentHarness harness;
  const auto& enhanced = harness.collect(topics::kOdometryEnhanced);
  harness.load("panvo_recorder", "BagPlayerComponent", {{"directory", bag_.string()}});
  harness.container().run();
  ASSERT_EQ(enhanced.size(), 1u);
  EXPECT_EQ(enhanced[0]->header().stamp().sec(), 99);
}

TEST_F(BagPlayer, PlaysTheTopicsItIsToldTo) {
  ComponentHarness harness;
  harness.add<Witness>("witness");
  harness.load("panvo_recorder", "BagPlayerComponent", {{"directory", bag_.string()}, {"exclude", "[/odometry/.*]"}});
  harness.container().run();
  EXPECT_THAT(Witness::seen, ElementsAre("tf"));
}

TEST_F(BagPlayer, IsRecordedAgainBitForBit) {
  {
    ComponentHarness harness;
    harness.load("panvo_recorder", "RecorderComponent",
                 {{"output", (folder_ / "again").string()}, {"exclude", "[/rosout]"}});
    runtime::ComponentDescription player;
    player.package = "panvo_recorder";
    player.plugin = "BagPlayerComponent";
    player.name = "bag_player";  // the harness would name both components after the package
    player.name_space = "/";
    player.parameters["directory"] = {.items = {bag_.string()}, .is_list = false, .where = {"test", 0}};
    harness.container().load(player);
    harness.container().run();
  }
  BagReader first(bag_);
  BagReader second(folder_ / "again");
  const auto messages = read_all(first);
  EXPECT_EQ(messages.size(), 5u);
  EXPECT_EQ(messages, read_all(second));
}

TEST_F(BagPlayer, PlaysWhatIsLeftOfABagThatWasCutOff) {
  const auto file = bag_ / "bag_0.db3";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  ComponentHarness harness;
  harness.add<Witness>("witness");
  harness.load("panvo_recorder", "BagPlayerComponent", {{"directory", bag_.string()}});
  EXPECT_THAT(harness.container().run(), testing::IsEmpty());
  EXPECT_TRUE(harness.log_contains("bag_0.db3: is cut off"));
  // The last page holds the timestamp index; all messages are intact.
  EXPECT_THAT(Witness::seen, ElementsAre("odometry 1", "odometry 2", "tf", "odometry 3"));
}

TEST_F(BagPlayer, IsRefusedWithABagThatHasNothingForIt) {
  const auto with = [&](const std::string& name, const std::string& value) {
    return refusal({{"directory", bag_.string()}, {name, value}});
  };
  EXPECT_THAT(refusal({}), HasSubstr("directory"));
  EXPECT_THAT(refusal({{"directory", (folder_ / "none").string()}}), HasSubstr("does not exist"));
  EXPECT_THAT(with("topics", "[/odometri/.*]"),
              testing::AllOf(HasSubstr("no topic matches /odometri/.*"), HasSubstr("/odometry/binocular")));
  EXPECT_THAT(with("exclude", "[.*]"), HasSubstr("no messages selected to play"));
  { BagWriter writer(folder_ / "empty"); }
  EXPECT_THAT(refusal({{"directory", (folder_ / "empty").string()}}), HasSubstr("contains no messages"));
}

}  // namespace
}  // namespace panvo::recorder
