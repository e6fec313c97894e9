// SPDX-License-Identifier: Apache-2.0
// The component LandmarkStoreComponent with a store on a server, and the writer that it uses.
#include <chrono>

#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/runtime/testing.hpp"
#include "poses_message.hpp"
#include "save_caller.hpp"
#include "store_fixture.hpp"
#include "store_writer.hpp"

namespace panvo::landmarks {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::Not;

class ServerStoreComponent : public ServerTest {
 protected:
  /// One run of a robot.
  struct Robot {
    runtime::ComponentHarness harness;
    SaveCaller caller{harness};
    const std::vector<std::shared_ptr<const panvo_msgs::msg::PanoramicLandmark>>& published =
        harness.collect(topics::kLandmarks);

    explicit Robot(const std::string& location, const std::map<std::string, std::string>& more = {}) {
      std::map<std::string, std::string> parameters{{"file", location}, {"answer_s", "1"}};
      parameters.insert(more.begin(), more.end());
      harness.load("panvo_landmarks", "LandmarkStoreComponent", parameters);
    }
    void publish(const PanoramicLandmark& landmark, const DescriptionSettings& settings = made_up_settings()) {
      harness.publish(topics::kLandmarks, to_message(landmark, settings, "map"));
    }
    void publish_poses(const std::vector<PanoramicLandmark>& landmarks) {
      harness.publish(topics::kLandmarkPoses, to_poses_message(landmarks));
    }
    /// Position only: makes the component tell its notices.
    void drive_to(double x) {
      nav_msgs::msg::Odometry odometry;
      odometry.header().frame_id("map");
      odometry.pose().pose().position().x(x);
      odometry.pose().pose().orientation().w(1.0);
      for (int i = 0; i < 6; ++i) odometry.pose().covariance()[static_cast<std::size_t>(7 * i)] = 0.01;
      harness.publish(topics::kOdometryEnhanced, odometry);
    }
    bool tells(const std::string& text) {
      return becomes_true([&] {
        drive_to(1e6);
        return harness.log_contains(text);
      });
    }
  };

  std::string x_of(std::uint32_t id) const {
    return sql("SELECT x FROM panvo.landmark WHERE id = " + std::to_string(id));
  }
  std::string stored() const { return sql("SELECT count(*) FROM panvo.landmark"); }
  bool becomes_stored(const std::string& count) const {
    return becomes_true([&] {
      try {
        return stored() == count;
      } catch (const std::exception&) {
        return false;  // no tables yet
      }
    });
  }
};

PanoramicLandmark moved(PanoramicLandmark landmark, double by_m) {
  landmark.map_from_base.translation().x() += by_m;
  return landmark;
}

std::string diagnostic(const StoreWriter& writer, const std::string& name) {
  for (const auto& [key, text] : writer.diagnostics()) {
    if (key == name) return text;
  }
  return "";
}

TEST_F(ServerStoreComponent, NamesTheCommandThatCopiesADatabase) {
  Robot robot(location());
  const auto answer = robot.caller.save();
  EXPECT_FALSE(answer.success());
  EXPECT_THAT(answer.message(), HasSubstr("run panvo landmarks copy postgresql://"));
}

TEST_F(ServerStoreComponent, KeepsWhatIsPublishedAndBeginsWithItTheNextTime) {
  {
    Robot robot(location());
    for (std::uint32_t id = 1; id <= 3; ++id) robot.publish(made_up_landmark(id));
    robot.publish(moved(made_up_landmark(2), 5.0));
  }
  const LandmarkStore store(location());
  ASSERT_EQ(store.size(), 3U);
  EXPECT_EQ(difference(whole(store, 2), moved(made_up_landmark(2), 5.0)), "");
  EXPECT_EQ(store.uses().at(3).session, 1U);
  Robot next(location());
  EXPECT_EQ(next.published.size(), 3U);
  EXPECT_TRUE(next.harness.log_contains("3 landmarks loaded"));
}

TEST_F(ServerStoreComponent, KeepsTheLandmarksOfTwoRobotsApart) {
  {
    Robot first(location()), second(location());
    first.publish(made_up_landmark(1));
    ASSERT_TRUE(becomes_stored("1"));
    auto other = made_up_landmark(2);
    other.id = 1;  // both count from 1
    second.publish(other);
    ASSERT_TRUE(becomes_stored("2"));
    other.map_from_base.translation().x() = 77.0;
    second.publish(other);
    first.publish(moved(made_up_landmark(1), 3.0));
  }
  const LandmarkStore store(location());
  EXPECT_EQ(difference(whole(store, 1), moved(made_up_landmark(1), 3.0)), "");
  auto expected = made_up_landmark(2);
  expected.map_from_base.translation().x() = 77.0;
  EXPECT_EQ(difference(whole(store, 2), expected), "");
}

TEST_F(ServerStoreComponent, LosesNothingWhileTheServerIsAway) {
  {
    Robot robot(location());
    robot.publish(made_up_landmark(1));
    ASSERT_TRUE(becomes_stored("1"));
    server_->stop();
    for (const std::uint32_t id : {2U, 3U, 4U}) robot.publish(made_up_landmark(id));
    robot.publish(moved(made_up_landmark(3), 4.0));
    EXPECT_TRUE(robot.tells("the server cannot be reached"));
    EXPECT_TRUE(robot.tells("Landmarks are kept in memory until it answers"));
    server_->start();
    EXPECT_TRUE(robot.tells("the server answers again"));
    EXPECT_TRUE(becomes_stored("4"));
  }
  EXPECT_EQ(difference(whole(LandmarkStore(location()), 3), moved(made_up_landmark(3), 4.0)), "");
}

TEST_F(ServerStoreComponent, GoesOnWhileTheServerIsFrozen) {
  Robot robot(location());
  robot.publish(made_up_landmark(1));
  ASSERT_TRUE(becomes_stored("1"));
  server_->freeze();
  for (std::uint32_t id = 2; id <= 200; ++id) robot.publish(made_up_landmark(id));  // would wait 3 s for each
  EXPECT_TRUE(robot.tells("the server cannot be reached"));
  server_->thaw();
  EXPECT_TRUE(becomes_stored("200"));
}

TEST_F(ServerStoreComponent, EndsInTimeThoughTheServerIsFrozen) {
  const auto begin = std::chrono::steady_clock::now();
  {
    Robot robot(location());
    robot.publish(made_up_landmark(1));
    ASSERT_TRUE(becomes_stored("1"));
    server_->freeze();
    robot.publish(made_up_landmark(2));
  }
  // 5 s for the end, and at most 5 s to connect and 3 s for an answer; not a measure of speed.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
}

TEST_F(ServerStoreComponent, TellsWhatItHasNoRoomFor) {
  Robot robot(location(), {{"waiting", "10"}});
  robot.publish(made_up_landmark(1));
  ASSERT_TRUE(becomes_stored("1"));
  server_->stop();
  robot.publish(made_up_landmark(2));
  EXPECT_TRUE(robot.tells("cannot be reached"));  // by then it makes the first change, beside which ten may wait
  for (std::uint32_t id = 3; id <= 20; ++id) robot.publish(made_up_landmark(id));
  EXPECT_TRUE(robot.tells("no room for more changes while the server does not answer"));
  server_->start();
  EXPECT_TRUE(becomes_stored("12"));
  robot.publish(made_up_landmark(30));
  EXPECT_TRUE(becomes_stored("13"));
}

TEST_F(ServerStoreComponent, MovesNoLandmarkOfAnotherRobotForOneThatItHadNoRoomFor) {
  Robot first(location(), {{"waiting", "10"}});
  first.publish(made_up_landmark(1));
  ASSERT_TRUE(becomes_stored("1"));
  server_->stop();
  first.publish(made_up_landmark(2));
  EXPECT_TRUE(first.tells("cannot be reached"));
  for (std::uint32_t id = 3; id <= 20; ++id) first.publish(made_up_landmark(id));
  server_->start();
  ASSERT_TRUE(becomes_stored("12"));

  Robot second(location());
  for (std::uint32_t id = 13; id <= 20; ++id) {
    auto other = made_up_landmark(100 + id);
    other.id = id;
    second.publish(other);
  }
  ASSERT_TRUE(becomes_stored("20"));
  const std::string others = "SELECT * FROM panvo.landmark WHERE id > 12 ORDER BY id";
  const auto before = sql(others), x_before = x_of(12);
  std::vector<PanoramicLandmark> map;
  for (std::uint32_t id = 1; id <= 20; ++id) map.push_back(moved(made_up_landmark(id), 5.0));
  first.publish_poses(map);
  EXPECT_TRUE(becomes_true([&] { return x_of(12) != x_before; }));
  EXPECT_EQ(sql(others), before);
}

TEST_F(ServerStoreComponent, MovesNoLandmarkOfAnotherRobotForOneThatWasRefused) {
  LandmarkStore store(location(), made_up_settings());
  store.add(made_up_landmark(1));
  const auto writer = write_to_server(location(), made_up_settings(), little_patience(), {}, 10);
  auto broken = made_up_landmark(2);
  broken.covariance(0, 0) = -1.0;
  writer->write(NewLandmark{broken, made_up_settings(), std::nullopt});
  ASSERT_TRUE(becomes_true([&] { return diagnostic(*writer, "changes lost") == "1"; }));
  ASSERT_EQ(store.add(made_up_landmark(2), IfTaken::kNextId), 2U);
  const auto x_before = x_of(1);
  MovedLandmarks change;
  for (const std::uint32_t id : {1U, 2U}) {
    const auto to = moved(made_up_landmark(id), 5.0);
    change.poses.push_back({id, to.map_from_base, to.covariance});
  }
  writer->write(change);
  EXPECT_TRUE(becomes_true([&] { return x_of(1) != x_before; }));
  EXPECT_EQ(difference(whole(store, 2), made_up_landmark(2)), "");
}

TEST_F(ServerStoreComponent, MovesNoLandmarkThatWasAddedSinceItsOwnWasRemoved) {
  LandmarkStore store(location(), made_up_settings());
  for (std::uint32_t id = 1; id <= 3; ++id) store.add(made_up_landmark(id));
  Robot robot(location());
  const std::uint32_t last = 3;
  store.remove(std::span(&last, 1));
  EXPECT_EQ(store.add(made_up_landmark(3), IfTaken::kNextId), 4U) << "3 is free, but the robot knows it";
  const auto before = x_of(4), x_before = x_of(1);
  robot.publish_poses({moved(made_up_landmark(1), 5.0), moved(made_up_landmark(3), 5.0)});
  EXPECT_TRUE(becomes_true([&] { return x_of(1) != x_before; }));
  EXPECT_EQ(x_of(4), before);
}

TEST_F(ServerStoreComponent, IsRefusedAtStartIfTheServerIsAway) {
  server_->stop();
  EXPECT_THAT(error_of<std::runtime_error>([&] { const Robot robot(location()); }),
              HasSubstr("the server cannot be reached"));
}

TEST_F(ServerStoreComponent, KeepsNothingOfOtherSettingsAndSaysSo) {
  Robot first(location()), second(location());
  first.publish(made_up_landmark(1));
  ASSERT_TRUE(becomes_stored("1"));
  second.publish(made_up_landmark(2), {{"band_rows", "150"}, {"seed", "2"}});
  EXPECT_TRUE(second.tells("its landmarks were described with other settings: seed is 1 there, 2 here"));
  EXPECT_TRUE(second.tells("No more landmarks will be stored"));
  EXPECT_EQ(stored(), "1");
}

TEST_F(ServerStoreComponent, StoresNothingInAStoreThatIsToBeRead) {
  EXPECT_THAT(error_of<std::runtime_error>([&] {
                const Robot robot(location(), {{"read_only", "true"}});
              }),
              HasSubstr("contains no landmarks"));
  LandmarkStore(location(), made_up_settings()).add(made_up_landmark(1));
  {
    Robot robot(location(), {{"read_only", "true"}});
    EXPECT_EQ(robot.published.size(), 1U);
    robot.publish(made_up_landmark(2));
    robot.drive_to(3.0);
  }
  EXPECT_EQ(stored(), "1");
}

TEST_F(ServerStoreComponent, CountsWhatIsLostInItsDiagnostics) {
  { const LandmarkStore made(location(), made_up_settings()); }
  const auto writer = write_to_server(location(), made_up_settings(), little_patience(), {}, 2);
  server_->stop();
  for (std::uint32_t id = 1; id <= 6; ++id) {
    writer->write(NewLandmark{made_up_landmark(id), made_up_settings(), std::nullopt});
  }
  const auto value = [&](const std::string& name) { return diagnostic(*writer, name); };
  EXPECT_TRUE(becomes_true([&] { return value("store problem").find("cannot be reached") != std::string::npos; }));
  const auto waiting = std::stoi(value("changes waiting"));
  EXPECT_EQ(waiting + std::stoi(value("changes lost")), 6);
  EXPECT_GE(waiting, 2);
  writer->finish();
  std::string told;
  for (const auto& notice : writer->notices()) told += notice.text + "\n";
  EXPECT_THAT(told, HasSubstr(std::to_string(waiting) + " changes are lost: the server did not take them"));
  EXPECT_EQ(value("changes lost"), "6");
}

}  // namespace
}  // namespace panvo::landmarks
