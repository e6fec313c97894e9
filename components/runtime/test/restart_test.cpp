// SPDX-License-Identifier: Apache-2.0
// Components that throw in a live run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <future>
#include <mutex>

#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/testing.hpp"
#include "sensor_msgs/msg/Image.h"

namespace panvo::runtime {
namespace {

using sensor_msgs::msg::Image;
using testing::ElementsAre;
using testing::IsEmpty;

/// Late readers get the newest message.
constexpr interfaces::Topic<Image> kTask{"work", {.durability = interfaces::Durability::kTransientLocal, .depth = 1}};

Image one_pixel() {
  Image image;
  image.width(1);
  image.height(1);
  image.step(1);
  image.encoding("mono8");
  image.data({0});
  return image;
}

/// Records what the components of a test have done.
struct FragileRecord {
  std::mutex mutex;
  std::condition_variable changed;
  int made = 0, handled = 0;
  bool fails_again = false, cannot_be_made_anew = false;
  bool is_again = false;  // is_again() of the last instance

  bool reaches(const std::function<bool(const FragileRecord&)>& wanted) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, std::chrono::seconds(60), [&] { return wanted(*this); });
  }
};

/// The first instance fails on its first message.
class Fragile final : public Component {
 public:
  Fragile(Context& context, FragileRecord& record) : record_(record) {
    const std::lock_guard lock(record.mutex);
    is_to_fail_ = ++record.made == 1 || record.fails_again;
    record.is_again = context.is_again();
    record.changed.notify_all();
    if (record.made > 1 && record.cannot_be_made_anew) throw ConfigError("the camera is gone");
    context.input(kTask, [this](const std::shared_ptr<const Image>&) {
      if (is_to_fail_) throw std::runtime_error("out of ideas");
      const std::lock_guard handling(record_.mutex);
      ++record_.handled;
      record_.changed.notify_all();
    });
  }

 private:
  FragileRecord& record_;
  bool is_to_fail_ = false;
};

class Restart : public testing::Test {
 protected:
  void add(OnError on_error) {
    ComponentDescription description;
    description.name = "fragile";
    description.on_error = on_error;
    container.add(description, [this](Context& context) { return std::make_unique<Fragile>(context, record); });
    description.name = "writer";
    container.add(description, [this](Context& context) {
      const auto& type = interfaces::message_type<Image>();
      output = context.open_output({std::string(kTask.name), std::string(type.name), kTask.qos, &type});
      return std::make_unique<Component>();
    });
    finished = std::async(std::launch::async, [this] { return container.run(); });
  }
  void publish() { output->publish(std::make_shared<const Image>(one_pixel())); }
  std::vector<std::string> end() {
    container.request_stop();
    auto problems = finished.get();
    output.reset();
    return problems;
  }
  bool is_logged(const std::string& text) {
    const std::lock_guard lock(log_mutex);
    return std::ranges::any_of(log, [&](const auto& line) { return line.find(text) != std::string::npos; });
  }

  FragileRecord record;
  std::mutex log_mutex;
  std::vector<std::string> log;
  Container container{{.log = [this](LogLevel, const std::string&, const std::string& text) {
    const std::lock_guard lock(log_mutex);
    log.push_back(text);
  }}};
  std::shared_ptr<UntypedOutput> output;
  std::future<std::vector<std::string>> finished;
};

TEST_F(Restart, AComponentThatThrowsIsMadeAnewAndGetsWhatTopicsHold) {
  add(OnError::kRestart);
  publish();
  ASSERT_TRUE(record.reaches([](const FragileRecord& now) { return now.handled == 1; }));
  EXPECT_EQ(record.made, 2);
  EXPECT_TRUE(record.is_again);
  EXPECT_THAT(end(), IsEmpty());
  EXPECT_TRUE(is_logged("restarting in 0.1 s"));
}

TEST_F(Restart, OneThatCannotBeMadeAnewIsTriedAgainAndReported) {
  record.cannot_be_made_anew = true;
  add(OnError::kRestart);
  publish();
  ASSERT_TRUE(record.reaches([](const FragileRecord& now) { return now.made >= 3; }));
  EXPECT_THAT(end(), ElementsAre("fragile stopped by an error and could not be restarted, see the log"));
  EXPECT_TRUE(is_logged("the camera is gone"));
}

TEST_F(Restart, AContainerStopsWhereItsComponentSaysSo) {
  add(OnError::kStop);
  publish();
  ASSERT_EQ(finished.wait_for(std::chrono::seconds(60)), std::future_status::ready);
  EXPECT_THAT(end(), ElementsAre("fragile stopped by an error, see the log"));
  EXPECT_EQ(record.made, 1);
  EXPECT_FALSE(record.is_again);
}

TEST(RestartInReplay, IsNot) {
  FragileRecord record;
  ComponentHarness harness;
  ComponentDescription description;
  description.name = "fragile";
  description.on_error = OnError::kRestart;
  harness.container().add(description, [&](Context& context) { return std::make_unique<Fragile>(context, record); });
  for (int i = 0; i < 3; ++i) harness.publish(kTask, one_pixel());
  EXPECT_THAT(harness.container().run(), ElementsAre("fragile stopped by an error, see the log"));
  EXPECT_EQ(record.made, 1);
}

}  // namespace
}  // namespace panvo::runtime
