// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "called_node.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/recorder/bag_reader.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "test_bag.hpp"

namespace panvo::recorder {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;
using runtime::ComponentHarness;
using testing::HasSubstr;

nav_msgs::msg::Odometry odometry_number(std::int32_t sec) {
  nav_msgs::msg::Odometry message;
  message.header().stamp().sec(sec);
  message.header().frame_id("odom");
  return message;
}

sensor_msgs::msg::Image image(std::uint32_t bytes) {
  sensor_msgs::msg::Image message;
  message.encoding("mono8");
  message.width(10);
  message.height(bytes / 10);
  message.step(10);
  message.data().resize(bytes, 7);
  return message;
}

template <class Message>
interfaces::Bytes encoded(const Message& message) {
  const auto& type = interfaces::message_type<Message>();
  interfaces::Bytes bytes(type.serialized_size(&message));
  type.serialize(&message, bytes);
  return bytes;
}

/// Publishes three images for each odometry.
class ThreeImages final : public runtime::Component {
 public:
  explicit ThreeImages(runtime::Context& context) : images_(context.output(topics::kStereoLeftImageRaw)) {
    context.input(topics::kOdometryBinocular, [this](const std::shared_ptr<const nav_msgs::msg::Odometry>&) {
      for (int i = 0; i < 3; ++i) {
        images_.publish(image(600'000));
      }
    });
  }

 private:
  runtime::Output<sensor_msgs::msg::Image> images_;
};

/// Unloads the recorder when that has received three images and, in replay, written none of them.
class Unloader final : public runtime::Component {
 public:
  Unloader(runtime::Context& context, runtime::Container& container) {
    context.input(topics::kStereoLeftImageRaw, [&, this](const std::shared_ptr<const sensor_msgs::msg::Image>&) {
      if (++images_ == 3) container.unload("recorder");
    });
  }

 private:
  int images_ = 0;
};

/// A source that publishes one odometry at time kTime.
template <std::int64_t kTime>
class OneStep final : public runtime::Component, public runtime::Source {
 public:
  explicit OneStep(runtime::Context& context) : odometry_(context.output(topics::kOdometryBinocular)) {
    context.source(*this);
  }
  std::optional<std::int64_t> next_stamp_ns() override { return done_ ? std::nullopt : std::optional(kTime); }
  void emit() override {
    done_ = true;
    odometry_.publish(odometry_number(1));
  }
  Progress progress() const override { return {}; }

 private:
  runtime::Output<nav_msgs::msg::Odometry> odometry_;
  bool done_ = false;
};

class Recorder : public testing::Test {
 protected:
  using ParameterTexts = std::map<std::string, std::string>;

  void record(ParameterTexts parameters = {}, bool again = false) {
    parameters.emplace("output", bag_.string());
    harness_.emplace(runtime::ContainerOptions{.replay = true, .again = again});
    harness_->load("panvo_recorder", "RecorderComponent", parameters);
  }
  std::string refusal(const ParameterTexts& parameters) {
    try {
      record(parameters);
    } catch (const runtime::ConfigError& error) {
      return error.what();
    }
    return "";
  }
  /// Recorded times of a message published before the source's first step and of the source's message.
  template <class SourceClass>
  std::vector<std::int64_t> times_of_early_and_first() {
    // In a new thread, since replay time is thread-local and other tests have set it in this thread.
    std::thread([this] {
      record({{"topics", "[/odometry/.*, /tf]"}});
      harness_->publish(topics::kTf, tf2_msgs::msg::TFMessage());
      harness_->add<SourceClass>("one_step");
      harness_->container().run();
      harness_.reset();
    }).join();
    BagReader reader(bag_);
    std::vector<std::int64_t> times;
    for (const auto& message : read_all(reader)) {
      times.push_back(message.timestamp_ns);
    }
    return times;
  }
  std::vector<std::string> recorded_topics() {
    harness_.reset();
    const BagReader reader(bag_);
    std::vector<std::string> names;
    for (const auto& topic : reader.metadata().topics) {
      names.push_back(topic.name);
    }
    return names;
  }

  TemporaryFolder folder_;
  const std::filesystem::path bag_ = folder_ / "bag";
  std::optional<ComponentHarness> harness_;
};

TEST_F(Recorder, WritesWhatIsPublished) {
  record();
  harness_->publish(topics::kOdometryBinocular, odometry_number(1));
  harness_->publish(topics::kStereoLeftImageRaw, image(1000));
  harness_->publish(topics::kOdometryBinocular, odometry_number(2));
  harness_.reset();
  BagReader reader(bag_);
  EXPECT_THAT(reader.warnings(), testing::IsEmpty());
  std::vector<interfaces::Bytes> odometries;
  while (const auto* message = reader.next()) {
    const auto& topic = reader.metadata().topics[message->topic];
    if (topic.name == "/odometry/binocular") {
      EXPECT_EQ(topic.type, "nav_msgs/msg/Odometry");
      EXPECT_EQ(topic.type_description_hash, interfaces::message_type<nav_msgs::msg::Odometry>().hash);
      odometries.push_back(message->data);
    }
  }
  EXPECT_THAT(odometries, testing::ElementsAre(encoded(odometry_number(1)), encoded(odometry_number(2))));
}

TEST_F(Recorder, WritesMcapWhenToldTo) {
  record({{"storage", "mcap"}, {"compression", "zstd"}});
  harness_->publish(topics::kOdometryBinocular, odometry_number(1));
  harness_.reset();
  BagReader reader(bag_);
  EXPECT_THAT(reader.warnings(), testing::IsEmpty());
  EXPECT_EQ(reader.metadata().storage_identifier, "mcap");
  const auto messages = read_all(reader);
  EXPECT_TRUE(std::any_of(messages.begin(), messages.end(),
                          [](const Read& message) { return message.data == encoded(odometry_number(1)); }));
}

TEST_F(Recorder, TakesTheTopicsItIsToldTo) {
  record({{"topics", "[/odometry/.*, /tf_static]"}, {"exclude", "[.*/enhanced]"}});
  harness_->publish(topics::kOdometryBinocular, odometry_number(1));
  harness_->publish(topics::kOdometryEnhanced, odometry_number(1));
  harness_->publish(topics::kStereoLeftImageRaw, image(10));
  harness_->publish(topics::kTfStatic, tf2_msgs::msg::TFMessage());
  EXPECT_THAT(recorded_topics(), testing::UnorderedElementsAre("/odometry/binocular", "/tf_static"));
}

TEST_F(Recorder, LeavesImagesOutWhenToldTo) {
  record({{"include_images", "false"}});
  harness_->publish(topics::kOdometryBinocular, odometry_number(1));
  harness_->publish(topics::kStereoLeftImageRaw, image(10));
  EXPECT_THAT(recorded_topics(), testing::ElementsAre("/odometry/binocular"));
}

TEST_F(Recorder, DoesNotRecordWhatItSaysItself) {
  record({{"topics", "[/rosout]"}});
  EXPECT_TRUE(harness_->log_contains("recording to"));
  EXPECT_THAT(recorded_topics(), testing::IsEmpty());
}

TEST_F(Recorder, RemembersThatATopicIsLatched) {
  record({{"topics", "[/tf_static]"}});
  harness_->publish(topics::kTfStatic, tf2_msgs::msg::TFMessage());
  harness_.reset();
  const BagReader reader(bag_);
  const auto& profiles = reader.metadata().topics.at(0).offered_qos_profiles;
  ASSERT_EQ(profiles.size(), 1u);
  EXPECT_EQ(profiles[0].durability, QosProfile::Durability::kTransientLocal);
}

TEST_F(Recorder, CountsWhatItDropsWhenTheDiskIsTooSlow) {
  // In replay, the messages of one step wait until the step ends: three images of 600 kB exceed the queue.
  record({{"queue_mb", "1"}, {"topics", "[/stereo/.*]"}});
  harness_->add<ThreeImages>("three_images");
  harness_->publish(topics::kOdometryBinocular, odometry_number(1));
  EXPECT_TRUE(harness_->log_contains("dropped"));
  harness_.reset();
  BagReader reader(bag_);
  const auto messages = read_all(reader);
  EXPECT_EQ(messages.size() + dropped_messages(reader.metadata()), 3u);
  EXPECT_GT(dropped_messages(reader.metadata(), "/stereo/left/image_raw"), 0u);
}

TEST_F(Recorder, WritesWhatWaitsWhenItIsUnloaded) {
  record({{"queue_mb", "1"}, {"topics", "[/stereo/.*]"}});
  harness_->add<ThreeImages>("three_images");
  harness_->container().add(description("unloader"), [this](runtime::Context& context) {
    return std::make_unique<Unloader>(context, harness_->container());
  });
  harness_->publish(topics::kOdometryBinocular, odometry_number(1));
  EXPECT_THAT(harness_->container().components(), testing::Not(testing::Contains("recorder")));
  BagReader reader(bag_);
  EXPECT_EQ(read_all(reader).size(), 2u);
  EXPECT_EQ(dropped_messages(reader.metadata(), "/stereo/left/image_raw"), 1u) << "which found the queue full";
}

TEST_F(Recorder, KeepsTheBagsOfTheCrashedProcessesThatItReplaces) {
  for (const bool again : {false, true, true}) {
    record({{"overwrite", "true"}, {"topics", "[/odometry/.*]"}}, again);
    harness_->publish(topics::kOdometryBinocular, odometry_number(1));
    EXPECT_EQ(harness_->log_contains("what was recorded before the crash is kept"), again);
    harness_.reset();
  }
  for (const char* name : {"bag", "bag_2", "bag_3"}) {
    BagReader reader(folder_ / name);
    EXPECT_EQ(read_all(reader).size(), 1u) << name;
  }
}

TEST_F(Recorder, LeavesOutTopicsBeyondTheMostAndNamesThem) {
  record({{"max_topics", "1"}, {"topics", "[/odometry/.*, /tf]"}});
  harness_->publish(topics::kOdometryBinocular, odometry_number(1));
  harness_->publish(topics::kTf, tf2_msgs::msg::TFMessage());
  harness_->publish(topics::kOdometryBinocular, odometry_number(2));
  harness_->publish(topics::kOdometryEnhanced, odometry_number(1));
  EXPECT_TRUE(harness_->log_contains("1 topics are skipped, e.g. /tf: max_topics is 1"));
  harness_->container().run();
  EXPECT_TRUE(harness_->log_contains("2 topics are skipped, e.g. /odometry/enhanced: max_topics is 1; increase it"));
  EXPECT_THAT(recorded_topics(), testing::ElementsAre("/odometry/binocular"));
}

TEST_F(Recorder, FailsARunOfWhichItRecordedNothing) {
  record({{"topics", "[/tf]"}});
  harness_->add<OneStep<kStart>>("one_step");
  EXPECT_THAT(harness_->container().run(), testing::ElementsAre(HasSubstr("nothing was recorded to " + bag_.string())));
}

TEST_F(Recorder, FailsARunAtWhoseEndItsFileIsGone) {
  record({{"topics", "[/odometry/.*]"}});
  harness_->publish(topics::kOdometryBinocular, odometry_number(1));
  std::filesystem::remove_all(bag_);
  harness_->add<OneStep<kStart>>("one_step");
  EXPECT_THAT(harness_->container().run(), testing::ElementsAre(HasSubstr("was removed while it was being recorded")));
  harness_.reset();
  BagReader reader(bag_);
  EXPECT_EQ(read_all(reader).size(), 2u);
}

TEST_F(Recorder, GivesWhatCameBeforeTheReplaysFirstTimeThatTime) {
  EXPECT_THAT(times_of_early_and_first<OneStep<kStart>>(), testing::ElementsAre(kStart, kStart));
}

TEST_F(Recorder, LeavesTimesAloneThatBeginAtZero) {
  EXPECT_THAT(times_of_early_and_first<OneStep<100'000'000>>(), testing::ElementsAre(0, 100'000'000));
}

TEST_F(Recorder, IsRefusedWithABadFolderOrPattern) {
  EXPECT_THAT(refusal({{"topics", "[/stereo/[]"}}), HasSubstr("/stereo/["));
  EXPECT_THAT(refusal({{"output", "/proc/bag"}}), HasSubstr("/proc/bag"));
  EXPECT_THAT(refusal({{"storage", "tape"}}), HasSubstr("sqlite3, mcap"));
  EXPECT_THAT(refusal({{"compression", "zstd"}}), HasSubstr("choose the storage mcap"));
  record();
  harness_.reset();
  EXPECT_THAT(refusal({}), HasSubstr("already exists"));
  EXPECT_EQ(refusal({{"overwrite", "true"}}), "");
}

}  // namespace
}  // namespace panvo::recorder
