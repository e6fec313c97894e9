// SPDX-License-Identifier: Apache-2.0
// A bag that is controlled while it is played, live and without DDS.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <thread>

#include "called_node.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/container.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "rosbag2_interfaces/srv/GetRate.h"
#include "rosbag2_interfaces/srv/IsPaused.h"
#include "rosbag2_interfaces/srv/Pause.h"
#include "rosbag2_interfaces/srv/Resume.h"
#include "rosbag2_interfaces/srv/Seek.h"
#include "rosbag2_interfaces/srv/SetRate.h"
#include "rosbag2_interfaces/srv/TogglePaused.h"
#include "test_bag.hpp"

namespace panvo::recorder {
namespace {

using namespace rosbag2_interfaces::srv;  // NOLINT(google-build-using-namespace)

constexpr std::int64_t kSecond = 1'000'000'000;

/// A bag with a static transform, then odometry 0 and 1 at one time, and odometry 2 an hour later, played by
/// "/rosbag2_player".
class PlayerServices : public testing::Test {
 protected:
  void SetUp() override {
    {
      BagWriter writer(folder_ / "bag");
      const int topic = writer.add_topic(
          BagTopic::of("/odometry/binocular", *interfaces::find_message_type("nav_msgs/msg/Odometry"), {}));
      const int transforms = writer.add_topic(BagTopic::of(std::string(topics::kTfStatic.name),
                                                           *interfaces::find_message_type("tf2_msgs/msg/TFMessage"),
                                                           topics::kTfStatic.qos));
      writer.write(transforms, start_ns_ - 1000, runtime::to_bytes(tf2_msgs::msg::TFMessage()));
      for (const std::int32_t number : {0, 1, 2}) {
        nav_msgs::msg::Odometry message;
        message.header().stamp().sec(number);
        writer.write(topic, start_ns_ + number * 1000 + (number == 2 ? 3600 * kSecond : 0), runtime::to_bytes(message));
      }
    }
    container_.observe(
        [](const runtime::TopicDescription& topic) {
          return topic.name == "/odometry/binocular" || topic.name == topics::kTfStatic.name;
        },
        [this](const runtime::TopicDescription& topic, const runtime::SamplePtr& sample) {
          const std::lock_guard lock(mutex_);
          if (topic.name == topics::kTfStatic.name) return transforms_before_.push_back(played_.size());
          played_.push_back(runtime::Sample::as<nav_msgs::msg::Odometry>(sample)->header().stamp().sec());
          changed_.notify_all();
        });
    container_.add(test::description("caller"), [this](runtime::Context& context) {
      access_ = context.topic_access();
      playback_ = &context.playback();
      return std::make_unique<runtime::Component>();
    });
    auto player = test::description("rosbag2_player");
    player.package = "panvo_recorder";
    player.plugin = "BagPlayerComponent";
    const auto set = [&](const std::string& name, const std::string& value) {
      player.parameters[name] = {.items = {value}, .is_list = false, .where = {"test", 0}};
    };
    set("directory", (folder_ / "bag").string());
    set("wait_at_end", "true");
    set("start_paused", "true");
    container_.load(player);
    container_.start();
    run_ = std::thread([this] { container_.run(); });
  }

  void TearDown() override {
    container_.request_stop();
    run_.join();
    access_.reset();
  }

  template <class Response, class Request>
  Response call(const std::string& service, const Request& request) {
    return test::call_service<Response>(*access_, "/rosbag2_player/" + service, request);
  }
  bool is_paused() { return call<IsPaused_Response>("is_paused", IsPaused_Request()).paused(); }
  bool seek(std::int64_t time_ns) {
    Seek_Request request;
    request.time().sec(static_cast<std::int32_t>(time_ns / kSecond));
    request.time().nanosec(static_cast<std::uint32_t>(time_ns % kSecond));
    return call<Seek_Response>("seek", request).success();
  }
  bool set_rate(double rate) {
    SetRate_Request request;
    request.rate(rate);
    return call<SetRate_Response>("set_rate", request).success();
  }

  /// What has been played, once it is this much.
  std::vector<int> played(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(30), [&] { return played_.size() >= count; });
    return played_;
  }

  panvo::test::TemporaryFolder folder_;
  const std::int64_t start_ns_ = test::kStart;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<int> played_;
  std::vector<std::size_t> transforms_before_;  // index of the odometry that was played next
  std::unique_ptr<runtime::TopicAccess> access_;
  runtime::Playback* playback_ = nullptr;
  runtime::Container container_{
      runtime::ContainerOptions{.rate = 1, .log = [](runtime::LogLevel, const std::string&, const std::string&) {}}};
  std::thread run_;
};

TEST_F(PlayerServices, PauseAndResume) {
  EXPECT_TRUE(is_paused());
  EXPECT_THAT(played(0), testing::IsEmpty());
  call<Resume_Response>("resume", Resume_Request());
  EXPECT_FALSE(is_paused());
  EXPECT_THAT(played(2), testing::ElementsAre(0, 1));
  call<Pause_Response>("pause", Pause_Request());
  EXPECT_TRUE(is_paused());
  call<TogglePaused_Response>("toggle_paused", TogglePaused_Request());
  EXPECT_FALSE(is_paused());
}

TEST_F(PlayerServices, MoveForwardAndBackAlsoFromTheEnd) {
  call<Resume_Response>("resume", Resume_Request());
  played(2);
  EXPECT_TRUE(seek(start_ns_ + 3600 * kSecond));
  EXPECT_THAT(played(3), testing::ElementsAre(0, 1, 2));
  EXPECT_TRUE(seek(start_ns_ + 1000));
  EXPECT_THAT(played(4), testing::ElementsAre(0, 1, 2, 1));
}

TEST_F(PlayerServices, PlayLatchedMessagesAgainAfterAMove) {
  call<Resume_Response>("resume", Resume_Request());
  played(2);
  EXPECT_TRUE(seek(start_ns_ + 1000));  // back
  played(3);
  EXPECT_TRUE(seek(start_ns_ + 3600 * kSecond));  // and on
  EXPECT_THAT(played(4), testing::ElementsAre(0, 1, 1, 2));
  const std::lock_guard lock(mutex_);
  EXPECT_THAT(transforms_before_, testing::ElementsAre(0, 2, 3));
}

TEST_F(PlayerServices, MoveWhilePausedWithoutPlaying) {
  EXPECT_TRUE(seek(start_ns_ + 1000));
  EXPECT_TRUE(is_paused());
  call<Resume_Response>("resume", Resume_Request());
  EXPECT_THAT(played(1), testing::ElementsAre(1));
}

/// Viewers show this time, and move the bag from there.
TEST_F(PlayerServices, TellTheTimeOfAMoveWhilePausedWithinTheBag) {
  EXPECT_TRUE(seek(start_ns_ + 1000));
  EXPECT_EQ(playback_->stamp_ns(), start_ns_ + 1000);
  EXPECT_TRUE(seek(start_ns_ - 5 * kSecond));
  EXPECT_EQ(playback_->stamp_ns(), start_ns_ - 1000);  // the first message
  EXPECT_TRUE(seek(start_ns_ + 7200 * kSecond));
  EXPECT_EQ(playback_->stamp_ns(), start_ns_ + 3600 * kSecond + 2000);  // the last
}

TEST_F(PlayerServices, SetTheRate) {
  EXPECT_EQ(call<GetRate_Response>("get_rate", GetRate_Request()).rate(), 1);
  EXPECT_FALSE(set_rate(0));
  EXPECT_FALSE(set_rate(-2));
  EXPECT_TRUE(set_rate(1e6));  // an hour in 3.6 ms
  EXPECT_EQ(call<GetRate_Response>("get_rate", GetRate_Request()).rate(), 1e6);
  call<Resume_Response>("resume", Resume_Request());
  EXPECT_THAT(played(3), testing::ElementsAre(0, 1, 2));
}

}  // namespace
}  // namespace panvo::recorder
