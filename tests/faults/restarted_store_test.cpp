// SPDX-License-Identifier: Apache-2.0
// The process with the landmark store is killed and started again in the middle of a run, while the other processes go on
// with the ids of landmarks that they have.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <future>
#include <map>
#include <mutex>

#include "made_up_landmark.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/runtime/container.hpp"
#include "panvo/runtime/test_domain.hpp"
#include "panvo/sqlite/database.hpp"
#include "process.hpp"

namespace panvo::test {
namespace {

using landmarks::LandmarkStore;
using landmarks::PanoramicLandmark;
using landmarks::test::made_up_landmark;
using landmarks::test::made_up_settings;
using Stamps = std::map<std::uint32_t, std::int64_t>;  // tell which landmarks there are, by their ids

/// The process with the builder and the localizer.
class OtherProcess {
 public:
  OtherProcess() : container_({.dds = on_test_domain(), .name = "others"}) {
    runtime::ComponentDescription description;
    description.name = "builder";
    container_.add(description, [this](runtime::Context& context) {
      built_.emplace(context.output(topics::kLandmarks));
      poses_.emplace(context.output(topics::kLandmarkPoses));
      return std::make_unique<runtime::Component>();
    });
    description.name = "reader";
    container_.add(description, [this](runtime::Context& context) {
      context.input(topics::kLandmarks, [this](const auto& message) { on_landmark(*message); });
      return std::make_unique<runtime::Component>();
    });
    running_ = std::async(std::launch::async, [this] { return container_.run(); });
  }
  ~OtherProcess() {
    container_.request_stop();
    running_.wait();
    built_.reset();
    poses_.reset();
  }
  OtherProcess(const OtherProcess&) = delete;
  OtherProcess& operator=(const OtherProcess&) = delete;

  void build(const PanoramicLandmark& landmark) { built_->publish(to_message(landmark, made_up_settings(), "map")); }
  void move(const std::vector<PanoramicLandmark>& landmarks) {
    panvo_msgs::msg::LandmarkPoses message;
    for (const auto& landmark : landmarks) {
      message.ids().push_back(landmark.id);
      message.poses().push_back(to_message(landmark, made_up_settings(), "map").pose());
    }
    poses_->publish(message);
  }
  void forget() {
    const std::lock_guard lock(mutex_);
    received_.clear();
  }
  Stamps received() {
    const std::lock_guard lock(mutex_);
    return received_;
  }

 private:
  static runtime::DdsSettings on_test_domain() {
    auto settings = runtime::dds_settings_from_environment();
    settings.domain = runtime::test_domain();
    return settings;
  }
  void on_landmark(const panvo_msgs::msg::PanoramicLandmark& message) {
    const auto landmark = landmarks::to_landmark(message, made_up_settings());
    const std::lock_guard lock(mutex_);
    received_[message.id()] = landmark ? landmark->stamp_ns : 0;
  }

  std::mutex mutex_;
  Stamps received_;
  runtime::Container container_;
  std::optional<runtime::Output<panvo_msgs::msg::PanoramicLandmark>> built_;
  std::optional<runtime::Output<panvo_msgs::msg::LandmarkPoses>> poses_;
  std::future<std::vector<std::string>> running_;
};

PanoramicLandmark as(std::uint32_t id, std::uint32_t made_up, double moved_m = 0.0) {
  auto landmark = made_up_landmark(made_up);
  landmark.id = id;
  landmark.map_from_base.translation().x() += moved_m;
  return landmark;
}

class RestartedStore : public testing::Test {
 protected:
  /// The third one cannot be read, so that the next one that is built is the third of the run, but not of the store.
  void SetUp() override {
    {
      LandmarkStore store(file_, made_up_settings());
      for (const std::uint32_t id : {1U, 2U, 3U}) store.add(made_up_landmark(id));
    }
    sqlite::Database(file_, sqlite::Database::Mode::kReadWrite)
        .execute("UPDATE keypoints SET data = x'00' WHERE landmark_id = 3");
    std::ofstream(folder_ / "system.yaml") << "launch:\n"
                                              "- node_container:\n"
                                              "    name: store\n"
                                              "    respawn: true\n"
                                              "    respawn_delay: 0.1\n"
                                              "    composable_node:\n"
                                              "    - pkg: panvo_landmarks\n"
                                              "      plugin: LandmarkStoreComponent\n"
                                              "      name: landmark_store\n"
                                              "      param:\n"
                                              "      - {name: file, value: " +
                                                  file_ + "}\n";
  }
  std::map<std::uint32_t, double> stored_x() const {
    std::map<std::uint32_t, double> x;
    for (const auto& landmark : LandmarkStore(file_).landmarks()) x[landmark.id] = landmark.map_from_base(0, 3);
    return x;
  }
  /// After a restart, the ids of the other process mean the same landmarks as before.
  void expect_to_go_on(OtherProcess& others, Process& system) const {
    Stamps all{{1, made_up_landmark(1).stamp_ns}, {2, made_up_landmark(2).stamp_ns}};
    all.insert({{3, made_up_landmark(30).stamp_ns}, {4, made_up_landmark(40).stamp_ns}});
    EXPECT_TRUE(eventually([&] { return others.received().size() >= 4; })) << system.output();
    EXPECT_EQ(others.received(), all) << "as before";
    others.move({as(3, 30, 2.0), as(4, 40, 7.0)});
    others.build(as(5, 50));
    const std::map<std::uint32_t, double> expected{
        {1, as(1, 1).map_from_base(0, 3)},       {2, as(2, 2).map_from_base(0, 3)},
        {3, as(3, 3).map_from_base(0, 3)},       {4, as(3, 30, 2.0).map_from_base(0, 3)},
        {5, as(4, 40, 7.0).map_from_base(0, 3)}, {6, as(5, 50).map_from_base(0, 3)}};
    EXPECT_TRUE(eventually([&] { return stored_x() == expected; })) << system.output();
    EXPECT_EQ(stored_x(), expected);
  }

  TemporaryFolder folder_;
  const std::string file_ = folder_ / "places";
};

TEST_F(RestartedStore, GoesOnWithTheIdsOfTheRun) {
  OtherProcess others;
  Process system({PANVO_RUN, folder_ / "system.yaml", "--domain", std::to_string(runtime::test_domain())});
  const Stamps earlier{{1, made_up_landmark(1).stamp_ns}, {2, made_up_landmark(2).stamp_ns}};
  ASSERT_TRUE(eventually([&] { return others.received() == earlier; })) << system.output();
  others.build(as(3, 30));
  others.build(as(4, 40));
  ASSERT_TRUE(eventually([&] { return stored_x().size() == 5; })) << system.output();

  const pid_t killed = child_of(system, "store");
  others.forget();
  kill(killed, SIGKILL);
  expect_to_go_on(others, system);
  EXPECT_THAT(system.output(), testing::HasSubstr("restarting container store"));
  system.signal(SIGINT);
  EXPECT_EQ(system.wait(), 0) << system.output();
}

/// As services that are restarted one by one: each launcher begins a run of its own.
TEST_F(RestartedStore, GoesOnWithTheIdsOfTheRunWithALauncherOfItsOwn) {
  OtherProcess others;
  const std::vector<std::string> command{PANVO_RUN, folder_ / "system.yaml", "--domain",
                                         std::to_string(runtime::test_domain())};
  {
    Process system(command);
    ASSERT_TRUE(eventually([&] { return others.received().size() == 2; })) << system.output();
    others.build(as(3, 30));
    others.build(as(4, 40));
    ASSERT_TRUE(eventually([&] { return stored_x().size() == 5; })) << system.output();
    system.signal(SIGINT);
    EXPECT_EQ(system.wait(), 0) << system.output();
  }
  others.forget();
  Process system(command);
  expect_to_go_on(others, system);
  system.signal(SIGINT);
  EXPECT_EQ(system.wait(), 0) << system.output();
}

}  // namespace
}  // namespace panvo::test
