// SPDX-License-Identifier: Apache-2.0
// The component LandmarkStoreComponent is restarted in the middle of a run, with its memory lost, while the other
// components go on with the ids of landmarks that they have.
#include <thread>

#include "store_fixture.hpp"
#include "store_life.hpp"

namespace panvo::landmarks {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::Pair;

class RestartedStoreOfEachKind : public StoreLivesOfEachKind {};

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
  expect_moved_and_added();
  EXPECT_THAT(LandmarkStore(where()).uses(),
              ElementsAre(Pair(4U, LandmarkUse{1, 0, 0, 0, 0}), Pair(5U, LandmarkUse{1, 1, 1, 0, 0}),
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
    next.wait();  // nobody says that monday's run goes on
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

/// Missed on two drives before, and on this one: another appearance is kept from the fourth on.
TEST_P(RestartedStoreOfEachKind, CountsTheMissOfOneDriveOnce) {
  const auto landmark = made_up_landmark(1);
  LandmarkStore(where(), made_up_settings()).add(landmark);
  LandmarkStore(where(), made_up_settings()).set_uses({{1, {1, 9, 7, 2, 0}}});
  const auto miss = [&](Life& life) {
    for (const Eigen::Vector3d& position : {Eigen::Vector3d(1e5, 1e5, 0.0), landmark.map_from_base.translation().eval(),
                                            Eigen::Vector3d(1e5, 1e5, 0.0)}) {
      life.drive_to(position);
    }
  };
  auto today = moved_by(3.0, landmark);
  today.id = 2;
  today.stamp_ns += 1;
  for (int life = 0; life < 3; ++life) {
    Life restarted(where(), "run");
    miss(restarted);
    restarted.publish(today);
  }
  EXPECT_EQ(LandmarkStore(where()).uses().at(1), (LandmarkUse{1, 12, 7, 5, 0}));
  EXPECT_EQ(LandmarkStore(where()).size(), 1U);
  {
    Life next(where(), "next");
    next.publish(today);
  }
  EXPECT_EQ(LandmarkStore(where()).size(), 2U);
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
