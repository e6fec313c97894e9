// SPDX-License-Identifier: Apache-2.0
// Components that throw in a live run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <condition_variable>
#include <future>
#include <mutex>
#include <optional>
#include <set>
#include <string>

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
  std::set<std::string> run_ids;
  std::function<void(int)> on_made = [](int) {};

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
    record.on_made(record.made);
    record.is_again = context.is_again();
    record.run_ids.insert(context.run_id());
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
  void TearDown() override { container.request_stop(); }  // also after a failed assertion

  void add_fragile(const std::string& name, OnError on_error, FragileRecord& its_record) {
    ComponentDescription description;
    description.name = name;
    description.on_error = on_error;
    container.add(description, [&](Context& context) { return std::make_unique<Fragile>(context, its_record); });
  }
  void add(OnError on_error) {
    add_fragile("fragile", on_error, record);
    ComponentDescription description;
    description.name = "writer";
    container.add(description, [this](Context& context) {
      const auto& type = interfaces::message_type<Image>();
      output = context.open_output({std::string(kTask.name), std::string(type.name), kTask.qos, &type});
      return std::make_unique<Component>();
    });
    finished = std::async(std::launch::async, [this] { return container.run(); });
  }
  void publish() { output->publish(std::make_shared<const Image>(one_pixel())); }
  void unload_all_but_the_fragile() { ASSERT_TRUE(container.unload("writer")); }  // it can still publish
  std::vector<std::string> end() {
    container.request_stop();
    auto problems = finished.get();
    output.reset();
    return problems;
  }
  bool is_logged(const std::string& text) {
    std::unique_lock lock(log_mutex);
    const auto has_text = [&](const auto& line) { return line.find(text) != std::string::npos; };
    return logged.wait_for(lock, std::chrono::seconds(60), [&] { return std::ranges::any_of(log, has_text); });
  }

  FragileRecord record;
  std::mutex log_mutex;
  std::condition_variable logged;
  std::vector<std::string> log;
  Container container{{.log = [this](LogLevel, const std::string&, const std::string& text) {
    const std::lock_guard lock(log_mutex);
    log.push_back(text);
    logged.notify_all();
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
  ASSERT_EQ(record.run_ids.size(), 1U) << "the same before and after";
  EXPECT_FALSE(record.run_ids.contains(""));
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

TEST_F(Restart, TheOnlyComponentOfAContainerIsMadeAnewToo) {
  add(OnError::kRestart);
  unload_all_but_the_fragile();
  publish();
  ASSERT_TRUE(record.reaches([](const FragileRecord& now) { return now.handled == 1; }));
  EXPECT_THAT(end(), IsEmpty());
}

TEST_F(Restart, ARunEndsOnceNoComponentWillBeMadeAnew) {  // takes the 11 s until a component is given up
  record.cannot_be_made_anew = true;
  FragileRecord hopeless;
  hopeless.fails_again = true;
  add_fragile("hopeless", OnError::kRestart, hopeless);
  add(OnError::kRestart);
  unload_all_but_the_fragile();
  publish();
  ASSERT_EQ(finished.wait_for(std::chrono::seconds(60)), std::future_status::ready);
  EXPECT_THAT(end(), ElementsAre("fragile stopped by an error and could not be restarted, see the log",
                                 "hopeless stopped by an error, see the log"));
  EXPECT_EQ(record.made, 4);
  EXPECT_EQ(hopeless.made, 4);
}

/// While it exists, no thread can be started: its stack would be larger than the address space.
class NoMoreThreads {
 public:
  NoMoreThreads() {
    pthread_getattr_default_np(&before_);
    pthread_attr_t huge;
    pthread_getattr_default_np(&huge);
    pthread_attr_setstacksize(&huge, std::size_t{1} << 60);
    pthread_setattr_default_np(&huge);
    pthread_attr_destroy(&huge);
  }
  ~NoMoreThreads() {
    pthread_setattr_default_np(&before_);
    pthread_attr_destroy(&before_);
  }
  NoMoreThreads(const NoMoreThreads&) = delete;
  NoMoreThreads& operator=(const NoMoreThreads&) = delete;

 private:
  pthread_attr_t before_{};
};

TEST_F(Restart, OneThatGetsNoThreadIsTriedAgain) {
  std::optional<NoMoreThreads> no_more_threads;
  record.on_made = [&](int made) { made == 2 ? void(no_more_threads.emplace()) : no_more_threads.reset(); };
  add(OnError::kRestart);
  publish();
  ASSERT_TRUE(record.reaches([](const FragileRecord& now) { return now.handled == 1; }));
  EXPECT_EQ(record.made, 3);
  EXPECT_TRUE(is_logged("could not be restarted: Resource temporarily unavailable"));
  EXPECT_THAT(end(), IsEmpty());
}

TEST_F(Restart, NoneIsMadeAnewOnceTheRunHasEnded) {
  record.fails_again = true;
  add(OnError::kRestart);
  publish();
  ASSERT_TRUE(is_logged("restarting in 0.1 s"));
  end();
  std::unique_lock lock(record.mutex);
  const int made = record.made;
  EXPECT_FALSE(record.changed.wait_for(lock, std::chrono::seconds(1), [&] { return record.made > made; }));
}

TEST_F(Restart, AContainerStopsWhereItsComponentSaysSo) {
  add(OnError::kStop);
  publish();
  ASSERT_EQ(finished.wait_for(std::chrono::seconds(60)), std::future_status::ready);
  EXPECT_THAT(end(), ElementsAre("fragile stopped by an error, see the log"));
  EXPECT_EQ(record.made, 1);
  EXPECT_FALSE(record.is_again);
}

std::string run_id_in(const ContainerOptions& options, const std::string& name = "one",
                      const std::string& name_space = "/") {
  std::string run_id;
  Container container(options);
  ComponentDescription description;
  description.name = name;
  description.name_space = name_space;
  container.add(description, [&](Context& context) {
    run_id = context.run_id();
    return std::make_unique<Component>();
  });
  return run_id;
}

TEST(RunId, IsThatOfOneComponentInOneRun) {
  const auto mine = run_id_in({.run_id = "7"});
  EXPECT_EQ(run_id_in({.again = true, .run_id = "7"}), mine);
  EXPECT_NE(run_id_in({.run_id = "8"}), mine);
  EXPECT_NE(run_id_in({.run_id = "7"}, "other"), mine);
  EXPECT_NE(run_id_in({.run_id = "7"}, "one", "/robot"), mine);
  EXPECT_NE(run_id_in({}), run_id_in({})) << "two runs";
  EXPECT_EQ(run_id_in({.replay = true}), "");
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
