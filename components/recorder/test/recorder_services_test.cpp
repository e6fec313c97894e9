// SPDX-License-Identifier: Apache-2.0
// A recorder that is controlled while it records, live and without DDS.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <future>
#include <mutex>

#include "called_node.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/container.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "rosbag2_interfaces/msg/WriteSplitEvent.h"
#include "rosbag2_interfaces/srv/IsPaused.h"
#include "rosbag2_interfaces/srv/Pause.h"
#include "rosbag2_interfaces/srv/Resume.h"
#include "rosbag2_interfaces/srv/SplitBagfile.h"
#include "test_bag.hpp"

namespace panvo::recorder {
namespace {

using namespace rosbag2_interfaces::srv;  // NOLINT(google-build-using-namespace)
using rosbag2_interfaces::msg::WriteSplitEvent;

/// A recorder "/rosbag2_recorder" of odometry that the test publishes.
class RecorderServices : public testing::Test {
 protected:
  void TearDown() override { container_.request_stop(); }  // also after a failed assertion

  void start(const std::map<std::string, std::string>& parameters = {},
             runtime::OnError on_error = runtime::OnError::kIgnore) {
    container_.observe([](const runtime::TopicDescription& topic) { return topic.name == "/events/write_split"; },
                       [this](const runtime::TopicDescription&, const runtime::SamplePtr& sample) {
                         const std::lock_guard lock(mutex_);
                         splits_.push_back(*runtime::Sample::as<WriteSplitEvent>(sample));
                         changed_.notify_all();
                       });
    container_.add(test::description("publisher"), [this](runtime::Context& context) {
      access_ = context.topic_access();
      odometry_.emplace(context.output(topics::kOdometryBinocular));
      return std::make_unique<runtime::Component>();
    });
    auto recorder = test::description("rosbag2_recorder");
    recorder.package = "panvo_recorder";
    recorder.plugin = "RecorderComponent";
    recorder.on_error = on_error;
    for (const auto& [name, value] : parameters) {
      recorder.parameters[name] = {.items = {value}, .is_list = false, .where = {"test", 0}};
    }
    recorder.parameters["output"] = {.items = {bag_.string()}, .is_list = false, .where = {"test", 0}};
    recorder.parameters["topics"] = {.items = {"/odometry/binocular"}, .is_list = true, .where = {"test", 0}};
    container_.load(recorder);
    container_.start();
    run_ = std::async(std::launch::async, [this] { return container_.run(); });
  }

  /// Returns the problems of the run.
  std::vector<std::string> stop() {
    container_.request_stop();
    auto problems = run_.get();
    access_.reset();
    odometry_.reset();
    return problems;
  }

  template <class Response, class Request>
  Response call(const std::string& service, const Request& request) {
    return test::call_service<Response>(*access_, "/rosbag2_recorder/" + service, request);
  }
  bool is_paused() { return call<IsPaused_Response>("is_paused", IsPaused_Request()).paused(); }

  void publish(int number) {
    nav_msgs::msg::Odometry message;
    message.header().stamp().sec(number);
    odometry_->publish(message);
  }

  std::vector<WriteSplitEvent> splits(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(30), [&] { return splits_.size() >= count; });
    return splits_;
  }

  /// Numbers of the recorded messages, by file.
  std::vector<std::vector<int>> recorded() {
    std::vector<std::vector<int>> files;
    const BagReader bag(bag_);
    for (const auto& file : bag.metadata().files) {
      BagReader reader(bag_ / file.path);
      files.emplace_back();
      while (const auto* message = reader.next()) {
        files.back().push_back(runtime::from_bytes<nav_msgs::msg::Odometry>(message->data).header().stamp().sec());
      }
    }
    return files;
  }

  bool is_logged(const std::string& text) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(30), [&] { return test::any_contains(log_, text); });
  }

  panvo::test::TemporaryFolder folder_;
  const std::filesystem::path bag_ = folder_ / "bag";
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<WriteSplitEvent> splits_;
  std::vector<std::string> log_;
  runtime::Container container_{runtime::ContainerOptions{
      .rate = 1, .log = [this](runtime::LogLevel, const std::string& component, const std::string& text) {
        const std::lock_guard lock(mutex_);
        log_.push_back(component + ": " + text);
        changed_.notify_all();
      }}};
  std::unique_ptr<runtime::TopicAccess> access_;
  std::optional<runtime::Output<nav_msgs::msg::Odometry>> odometry_;
  std::future<std::vector<std::string>> run_;
};

TEST_F(RecorderServices, LeaveOutWhatComesWhilePaused) {
  start();
  EXPECT_FALSE(is_paused());
  publish(1);
  call<Pause_Response>("pause", Pause_Request());
  EXPECT_TRUE(is_paused());
  publish(2);
  call<Resume_Response>("resume", Resume_Request());
  EXPECT_FALSE(is_paused());
  publish(3);
  is_paused();
  stop();
  EXPECT_THAT(recorded(), testing::ElementsAre(testing::ElementsAre(1, 3)));
}

TEST_F(RecorderServices, StartARecordingThatBeganPaused) {
  start({{"start_paused", "true"}});
  EXPECT_TRUE(is_paused());
  publish(1);
  call<Resume_Response>("resume", Resume_Request());
  publish(2);
  is_paused();
  stop();
  EXPECT_THAT(recorded(), testing::ElementsAre(testing::ElementsAre(2)));
}

TEST_F(RecorderServices, StartTheNextFileAndTellIt) {
  start();
  publish(1);
  call<SplitBagfile_Response>("split_bagfile", SplitBagfile_Request());
  const auto told = splits(1);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].closed_file(), (bag_ / "bag_0.db3").string());
  EXPECT_EQ(told[0].opened_file(), (bag_ / "bag_1.db3").string());
  EXPECT_EQ(told[0].node_name(), "/rosbag2_recorder");
  publish(2);
  is_paused();
  stop();
  EXPECT_THAT(recorded(), testing::ElementsAre(testing::ElementsAre(1), testing::ElementsAre(2)));
}

class UnloadedRecorder : public RecorderServices {};

TEST_F(UnloadedRecorder, HasWrittenAllThatWasPublished) {
  start();
  for (int i = 0; i < 2000; ++i) publish(i);
  EXPECT_TRUE(container_.unload("rosbag2_recorder"));
  stop();
  const BagReader bag(bag_);
  EXPECT_EQ(bag.metadata().message_count, 2000u);
  EXPECT_EQ(dropped_messages(bag.metadata()), 0u);
}

/// Throws in its first instance; restarted, it works.
class Fragile final : public runtime::Component {
 public:
  Fragile(runtime::Context& context, std::promise<void>& made_anew) {
    if (context.is_again()) {
      made_anew.set_value();
    } else {
      context.every(std::chrono::milliseconds(1), [] { throw std::runtime_error("broken"); });
    }
  }
};

/// A recorder that may overwrite bags and whose file is removed.
class FailedRecorder : public RecorderServices {
 protected:
  void fail() {
    start({{"overwrite", "true"}}, runtime::OnError::kRestart);
    publish(1);
    call<SplitBagfile_Response>("split_bagfile", SplitBagfile_Request());
    ASSERT_EQ(splits(1).size(), 1u);
    publish(2);
    is_paused();  // it has received it
    std::filesystem::remove(bag_ / "bag_1.db3");
    call<SplitBagfile_Response>("split_bagfile", SplitBagfile_Request());
    ASSERT_TRUE(is_logged("rosbag2_recorder: stopped by an error"));
  }
  /// Restarts follow the order of failures.
  void wait_for_restarts() {
    std::promise<void> made_anew;
    auto fragile = test::description("fragile");
    fragile.on_error = runtime::OnError::kRestart;
    container_.add(fragile, [&](runtime::Context& context) { return std::make_unique<Fragile>(context, made_anew); });
    made_anew.get_future().wait();
  }
};

TEST_F(FailedRecorder, IsNotMadeAnewAndKeepsItsBag) {
  fail();
  wait_for_restarts();
  EXPECT_THAT(stop(), testing::ElementsAre("rosbag2_recorder stopped by an error, see the log"));
  EXPECT_THAT(recorded(), testing::ElementsAre(testing::ElementsAre(1), testing::ElementsAre(2)));
}

TEST_F(FailedRecorder, CountsWhatItCouldNotRecord) {
  fail();
  for (int i = 3; i < 6; ++i) publish(i);
  is_paused();
  stop();
  const BagReader bag(bag_);
  EXPECT_EQ(dropped_messages(bag.metadata(), "/odometry/binocular"), 3u);
}

}  // namespace
}  // namespace panvo::recorder
