// SPDX-License-Identifier: Apache-2.0
// The component LandmarkStoreComponent is restarted in the middle of a run, with its memory lost, while the other
// components go on with the ids of landmarks that they have.
#include <thread>

#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/runtime/testing.hpp"
#include "poses_message.hpp"
#include "store_fixture.hpp"

namespace panvo::landmarks {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::Pair;

PanoramicLandmark with_id(std::uint32_t id, PanoramicLandmark landmark) {
  landmark.id = id;
  return landmark;
}

PanoramicLandmark moved_by(double by_m, PanoramicLandmark landmark) {
  landmark.map_from_base.translation().x() += by_m;
  return landmark;
}

/// The component from a start until its end, in a run.
struct Life {
  runtime::ComponentHarness harness;
  const std::vector<std::shared_ptr<const panvo_msgs::msg::PanoramicLandmark>>& published =
      harness.collect(topics::kLandmarks);

  Life(const StoreLocation& location, const std::string& run,
       const std::map<std::string, std::string>& more = {{"forget_after", "0"}})
      : harness({.replay = true, .run_id = run}) {
    std::map<std::string, std::string> parameters{{"file", location.text()}};
    parameters.insert(more.begin(), more.end());
    harness.load("panvo_landmarks", "LandmarkStoreComponent", parameters);
  }
  void publish(const PanoramicLandmark& landmark) {
    harness.publish(topics::kLandmarks, to_message(landmark, made_up_settings(), "map"));
  }
  void publish_poses(const std::vector<PanoramicLandmark>& landmarks) {
    harness.publish(topics::kLandmarkPoses, to_poses_message(landmarks));
  }
  /// From far away, drives past a landmark, recognises it, and drives away from all.
  void pass(const PanoramicLandmark& landmark) {
    panvo_msgs::msg::CorrectionOutcome outcome;
    outcome.landmark_id(landmark.id);
    outcome.outcome(panvo_msgs::msg::CorrectionOutcome_Constants::APPLIED);
    outcome.before().orientation().w(1.0);
    outcome.after().orientation().w(1.0);
    drive_to({1e5, 1e5, 0.0});
    drive_to(landmark.map_from_base.translation());
    harness.publish(topics::kCorrectionOutcome, outcome);
    drive_to({1e5, 1e5, 0.0});
  }
  void drive_to(const Eigen::Vector3d& position) {
    nav_msgs::msg::Odometry odometry;
    odometry.header().frame_id("map");
    odometry.pose().pose().position().x(position.x());
    odometry.pose().pose().position().y(position.y());
    odometry.pose().pose().orientation().w(1.0);
    for (int i = 0; i < 6; ++i) odometry.pose().covariance()[static_cast<std::size_t>(7 * i)] = 0.01;
    harness.publish(topics::kOdometryEnhanced, odometry);
  }
  /// Of what was published: ids, and the stamps that tell which landmarks they are.
  std::vector<std::pair<std::uint32_t, std::int64_t>> ids() const {
    std::vector<std::pair<std::uint32_t, std::int64_t>> ids;
    for (const auto& message : published) {
      const auto landmark = to_landmark(*message, made_up_settings());
      ids.emplace_back(message->id(), landmark ? landmark->stamp_ns : 0);
    }
    return ids;
  }
};

std::int64_t stamp_of(std::uint32_t made_up) { return made_up_landmark(made_up).stamp_ns; }

class RestartedStoreOfEachKind : public ServerTest, public testing::WithParamInterface<bool> {
 protected:
  void SetUp() override {
    if (GetParam()) ServerTest::SetUp();
  }
  StoreLocation where() const { return GetParam() ? StoreLocation(location()) : StoreLocation(folder_ / "store"); }
  /// Those who number landmarks have not heard of the third one, as it is damaged: their third one gets another number.
  void write_two_and_a_damaged_one() {
    LandmarkStore store(where(), made_up_settings());
    for (const std::uint32_t id : {1U, 2U, 3U}) store.add(made_up_landmark(id));
    if (GetParam()) {
      sql("UPDATE panvo.keypoints SET data = '\\x00' WHERE landmark_id = 3");
    } else {
      sqlite::Database(folder_ / "store", sqlite::Database::Mode::kReadWrite)
          .execute("UPDATE keypoints SET data = x'00' WHERE landmark_id = 3");
    }
  }
  double x_of(std::uint32_t stored) const {
    for (const auto& landmark : LandmarkStore(where()).landmarks()) {
      if (landmark.id == stored) return landmark.map_from_base.translation().x();
    }
    return std::nan("");
  }

  TemporaryFolder folder_;
  const PanoramicLandmark third_ = with_id(3, made_up_landmark(30));
  const PanoramicLandmark fourth_ = with_id(4, made_up_landmark(40));
};

INSTANTIATE_TEST_SUITE_P(Each, RestartedStoreOfEachKind, testing::Bool(),
                         [](const auto& of) { return of.param ? "Server" : "File"; });

TEST_P(RestartedStoreOfEachKind, HasTheLandmarksByTheIdsThatTheRunHasForThem) {
  write_two_and_a_damaged_one();
  {
    Life before(where(), "run");
    before.publish(third_);
    before.publish(fourth_);
  }
  {
    Life after(where(), "run");
    EXPECT_THAT(after.ids(), ElementsAre(Pair(1U, stamp_of(1)), Pair(2U, stamp_of(2)), Pair(3U, stamp_of(30)),
                                         Pair(4U, stamp_of(40))));
    after.publish(third_);  // as latched messages come again
    after.publish(fourth_);
    after.publish_poses({moved_by(2.0, third_), moved_by(7.0, fourth_)});
    after.publish(with_id(5, made_up_landmark(50)));
    after.pass(moved_by(7.0, fourth_));
  }
  const LandmarkStore store(where());
  ASSERT_EQ(store.size(), 6U);
  EXPECT_EQ(x_of(3), made_up_landmark(3).map_from_base.translation().x());
  EXPECT_EQ(difference(whole(store, 4), with_id(4, moved_by(2.0, third_))), "");
  EXPECT_EQ(difference(whole(store, 5), with_id(5, moved_by(7.0, fourth_))), "");
  EXPECT_EQ(difference(whole(store, 6), with_id(6, made_up_landmark(50))), "");
  EXPECT_THAT(store.uses(), ElementsAre(Pair(4U, LandmarkUse{1, 0, 0, 0, 0}), Pair(5U, LandmarkUse{1, 1, 1, 0, 0}),
                                        Pair(6U, LandmarkUse{1, 0, 0, 0, 0})))
      << "one run";
}

TEST_P(RestartedStoreOfEachKind, IsThatOfItsRunAlsoIfItIsRestartedTwice) {
  for (const std::uint32_t id : {1U, 2U, 3U}) {
    Life life(where(), "run");
    EXPECT_EQ(life.published.size(), id - 1);
    life.publish(made_up_landmark(id));
  }
  Life last(where(), "run");
  EXPECT_THAT(last.ids(), ElementsAre(Pair(1U, stamp_of(1)), Pair(2U, stamp_of(2)), Pair(3U, stamp_of(3))));
  for (const auto& [id, use] : LandmarkStore(where()).uses()) EXPECT_EQ(use.session, 1U) << id;
}

TEST_P(RestartedStoreOfEachKind, GoesOnWithoutTheIdsOfAnEarlierRun) {
  write_two_and_a_damaged_one();
  { Life(where(), "monday").publish(third_); }
  {
    Life next(where(), "tuesday");
    EXPECT_THAT(next.ids(), ElementsAre(Pair(1U, stamp_of(1)), Pair(2U, stamp_of(2)), Pair(4U, stamp_of(30))));
    next.publish(with_id(5, made_up_landmark(50)));
  }
  const LandmarkStore store(where());
  EXPECT_EQ(store.uses().at(4).session, 1U);
  EXPECT_EQ(store.uses().at(5).session, 2U);
}

TEST_P(RestartedStoreOfEachKind, CountsNoPassThatTheRestartCutInTwo) {
  const auto landmark = made_up_landmark(1);
  {
    Life before(where(), "run");
    before.publish(landmark);
    before.drive_to(landmark.map_from_base.translation());
  }
  {
    Life after(where(), "run");
    after.drive_to(landmark.map_from_base.translation());
    after.drive_to({1e5, 1e5, 0.0});
  }
  EXPECT_EQ(LandmarkStore(where()).uses().at(1), (LandmarkUse{1, 0, 0, 0, 0})) << "the drive that built it";
}

TEST_P(RestartedStoreOfEachKind, TakesNoLandmarkForAnotherOfTheSameId) {
  const auto first = made_up_landmark(1);
  const auto other = with_id(1, made_up_landmark(10));  // of a builder that was restarted and counts from 1 again
  {
    Life before(where(), "run");
    before.publish(first);
    before.publish(other);
    EXPECT_TRUE(before.harness.log_contains("landmark 1: its id is that of another one; it is not stored"));
  }
  Life(where(), "run").publish(other);
  const LandmarkStore store(where());
  ASSERT_EQ(store.size(), 1U);
  EXPECT_EQ(difference(whole(store, 1), first), "");
}

TEST_P(RestartedStoreOfEachKind, RemovesNothingInTheMiddleOfARun) {
  {
    LandmarkStore store(where(), made_up_settings());
    for (const std::uint32_t id : {1U, 2U}) store.add(made_up_landmark(id));
  }
  const std::map<std::string, std::string> forgetting{{"forget_after", "10"}};
  {
    Life before(where(), "run", forgetting);
    before.publish(made_up_landmark(3));
  }
  LandmarkStore(where(), made_up_settings()).set_uses({{1, {1, 12, 2, 10, 10}}});
  EXPECT_EQ(Life(where(), "run", forgetting).published.size(), 3U);
  EXPECT_EQ(Life(where(), "next", forgetting).published.size(), 2U);
}

/// What two robots store in one database.
class RestartedStoreOnServer : public ServerTest {
 protected:
  StoreLocation where() const { return StoreLocation(location()); }
  bool becomes_stored(const std::string& count) const {
    return becomes_true([&] {
      return sql("SELECT count(*) FROM pg_tables WHERE schemaname = 'panvo'") != "0" &&
             sql("SELECT count(*) FROM panvo.landmark") == count;
    });
  }
  std::string runs() const { return sql("SELECT string_agg(id, ',' ORDER BY id) FROM panvo.run"); }
};

TEST_F(RestartedStoreOnServer, LeavesTheLandmarksOfTheOtherRobotAlone) {
  Life first(where(), "first");
  first.publish(made_up_landmark(1));
  ASSERT_TRUE(becomes_stored("1"));
  const auto own_one = with_id(1, made_up_landmark(11)), own_two = with_id(2, made_up_landmark(12));
  {
    LandmarkStore(where(), made_up_settings()).remove(std::vector<std::uint32_t>{1});  // begins with an empty map
    Life second(where(), "second");
    second.publish(own_one);  // both count from 1
    ASSERT_TRUE(becomes_stored("1"));
    first.publish(made_up_landmark(2));
    ASSERT_TRUE(becomes_stored("2"));
    second.publish(own_two);
    ASSERT_TRUE(becomes_stored("3"));
  }
  {
    Life second(where(), "second");
    EXPECT_THAT(second.ids(), ElementsAre(Pair(1U, stamp_of(11)), Pair(2U, stamp_of(12))));
    second.publish(own_one);
    second.publish(own_two);
    second.publish_poses({moved_by(2.0, own_one), moved_by(7.0, own_two)});
    second.publish(with_id(3, made_up_landmark(13)));
    ASSERT_TRUE(becomes_stored("4"));
  }
  const LandmarkStore store(location());
  EXPECT_EQ(difference(whole(store, 2), with_id(2, moved_by(2.0, own_one))), "");
  EXPECT_EQ(difference(whole(store, 3), with_id(3, made_up_landmark(2))), "") << "the first robot's";
  EXPECT_EQ(difference(whole(store, 4), with_id(4, moved_by(7.0, own_two))), "");
  EXPECT_EQ(difference(whole(store, 5), with_id(5, made_up_landmark(13))), "");
}

TEST_F(RestartedStoreOnServer, ForgetsRunsThatAddedNothingForLongButNoneThatMayGoOn) {
  { Life(where(), "old").publish(made_up_landmark(1)); }
  { Life(where(), "other").publish(with_id(2, made_up_landmark(2))); }
  sql("UPDATE panvo.run SET at = now() - interval '31 days' WHERE id LIKE 'old%'");
  { const Life next(where(), "next"); }
  EXPECT_EQ(runs(), "next/landmarks,other/landmarks");
  EXPECT_EQ(sql("SELECT run, id_in_run, landmark_id FROM panvo.run_landmark"), "other/landmarks|2|2");
}

TEST_F(RestartedStoreOnServer, KeepsTheRunsOfSeveralThatBeginAtOnce) {
  { const LandmarkStore made(where(), made_up_settings()); }
  std::vector<std::thread> robots;
  for (int i = 0; i < 6; ++i) {
    robots.emplace_back([&, name = std::to_string(i)] {
      LandmarkStore store(where(), made_up_settings(), much_patience());
      store.begin_run({name, 1, 0, {}});
      store.add(made_up_landmark(7), IfTaken::kNextId);
    });
  }
  for (auto& robot : robots) robot.join();
  EXPECT_EQ(runs(), "0,1,2,3,4,5");
  EXPECT_EQ(sql("SELECT count(DISTINCT landmark_id), min(id_in_run), max(id_in_run) FROM panvo.run_landmark"), "6|7|7");
}

TEST_F(RestartedStoreOnServer, OfAnEarlierVersionIsUsedAsItIsWhereTheRightsAreThoseOfThatVersion) {
  { LandmarkStore(where(), made_up_settings()).add(made_up_landmark(1)); }
  sql("CREATE USER guest; GRANT USAGE ON SCHEMA panvo TO guest; GRANT ALL ON ALL TABLES IN SCHEMA panvo TO guest");
  auto as_guest = location();
  as_guest.replace(as_guest.find("user=panvo"), 10, "user=guest");
  { Life(as_guest, "run").publish(made_up_landmark(2)); }
  EXPECT_EQ(sql("SELECT count(*) FROM panvo.landmark"), "2");
  EXPECT_EQ(sql("SELECT to_regclass('panvo.run')"), "");
  { const Life owner(where(), "of the owner"); }
  ASSERT_EQ(runs(), "of the owner/landmarks");
  { Life(as_guest, "run").publish(made_up_landmark(3)); }
  EXPECT_EQ(sql("SELECT count(*) FROM panvo.landmark"), "3") << "there, but not for the guest";
  sql("DROP OWNED BY guest; DROP USER guest");
}

TEST(RestartedStore, LeavesNoTraceInTheFileOfAReplay) {
  const TemporaryFolder folder;
  for (const char* name : {"one", "two"}) {
    Life life(StoreLocation(folder / name), "");
    life.publish(made_up_landmark(1));
    life.pass(made_up_landmark(1));
  }
  EXPECT_EQ(folder.read("one"), folder.read("two"));
  const sqlite::Database database(folder / "one", sqlite::Database::Mode::kRead);
  EXPECT_FALSE(sqlite::Statement(database, "SELECT 1 FROM sqlite_master WHERE name LIKE 'run%'").step());
}

TEST(RestartedStore, KeepsInItsFileTheIdsOfOneRunAndTheLayoutThatEarlierVersionsRead) {
  const TemporaryFolder folder;
  for (const std::uint32_t day : {1U, 2U, 3U}) {
    Life(StoreLocation(folder / "store"), "day " + std::to_string(day)).publish(made_up_landmark(day));
  }
  const sqlite::Database database(folder / "store", sqlite::Database::Mode::kRead);
  sqlite::Statement run(database, "SELECT run.id, id_in_run, landmark_id FROM run JOIN run_landmark ON run = run.id");
  ASSERT_TRUE(run.step());
  EXPECT_EQ(run.text(0), "day 3/landmarks");
  EXPECT_EQ(run.integer(1), 3);
  EXPECT_EQ(run.integer(2), 3);
  EXPECT_FALSE(run.step());
  sqlite::Statement layout(database, "PRAGMA user_version");
  ASSERT_TRUE(layout.step());
  EXPECT_EQ(layout.integer(0), 1);
}

}  // namespace
}  // namespace panvo::landmarks
