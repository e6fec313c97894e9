// SPDX-License-Identifier: Apache-2.0
// The component LandmarkStoreComponent is restarted in the middle of a run by somebody who does not tell it the run: with
// another id of the run than before.
#include "store_life.hpp"

namespace panvo::landmarks {
namespace {

using namespace test;
using testing::Pair;
using testing::UnorderedElementsAre;

class StoreRestartedAlone : public StoreLivesOfEachKind {
 protected:
  void SetUp() override {
    StoreLivesOfEachKind::SetUp();
    write_two_and_a_damaged_one();
    Life before(where(), "before");
    before.publish(third_);
    before.publish(fourth_);
  }
  std::vector<std::pair<std::uint32_t, std::int64_t>> as_before() const {
    return {{1U, stamp_of(1)}, {2U, stamp_of(2)}, {3U, stamp_of(30)}, {4U, stamp_of(40)}};
  }
};

INSTANTIATE_TEST_SUITE_P(Each, StoreRestartedAlone, testing::Bool(),
                         [](const auto& of) { return of.param ? "Server" : "File"; });

TEST_P(StoreRestartedAlone, GoesOnWithTheRunOfTheBuilder) {
  {
    Life after(where(), "after");
    after.publish_poses({moved_by(2.0, third_), moved_by(7.0, fourth_)});
    after.publish(third_);  // as latched messages come again
    after.publish(fourth_);
    after.publish(with_id(5, made_up_landmark(50)));
    EXPECT_THAT(after.distinct_ids(),
                UnorderedElementsAre(Pair(1U, stamp_of(1)), Pair(2U, stamp_of(2)), Pair(3U, stamp_of(30)),
                                     Pair(4U, stamp_of(40)), Pair(5U, stamp_of(50))));
  }
  expect_moved_and_added();
  EXPECT_EQ(LandmarkStore(where()).uses().at(6).session, 1U) << "one run";
}

TEST_P(StoreRestartedAlone, GoesOnWithTheRunOfTheLocalizer) {
  {
    Life after(where(), "after");
    after.publish_poses({third_, fourth_});  // as optimised before; the builder was restarted, too
    after.wait();
    EXPECT_THAT(after.distinct_ids(),
                UnorderedElementsAre(as_before()[0], as_before()[1], as_before()[2], as_before()[3]));
    after.publish_poses({moved_by(2.0, third_), moved_by(7.0, fourth_)});
    after.publish(with_id(5, made_up_landmark(50)));
  }
  expect_moved_and_added();
  EXPECT_EQ(LandmarkStore(where()).uses().at(6).session, 1U) << "one run";
}

TEST_P(StoreRestartedAlone, BeginsAnewWhereAnotherBuilderCountsFromOne) {
  const auto other = with_id(3, made_up_landmark(60));
  {
    Life after(where(), "after");
    after.publish_poses({other});
    after.publish(other);
    after.wait();
    EXPECT_THAT(after.distinct_ids(),
                UnorderedElementsAre(Pair(3U, stamp_of(60)), Pair(1U, stamp_of(1)), Pair(2U, stamp_of(2)),
                                     Pair(4U, stamp_of(30)), Pair(5U, stamp_of(40))));
  }
  const LandmarkStore store(where());
  ASSERT_EQ(store.size(), 6U);
  EXPECT_EQ(difference(whole(store, 6), with_id(6, made_up_landmark(60))), "");
  EXPECT_EQ(store.uses().at(6).session, 2U);
}

TEST_P(StoreRestartedAlone, KeepsTheLastLandmarksUntilItsRunIsKnownAndSaysHowManyItLost) {
  if (GetParam()) GTEST_SKIP() << "what waits for the server has the same bound";
  const auto at_once = [](std::uint32_t id) {  // stamps tell a replay that time passes
    auto landmark = with_id(id, made_up_landmark(10 * id));
    landmark.stamp_ns = stamp_of(50) + id;
    return landmark;
  };
  {
    Life after(where(), "after", {{"forget_after", "0"}, {"waiting", "10"}});
    for (std::uint32_t id = 5; id < 17; ++id) after.publish(at_once(id));
    EXPECT_FALSE(after.harness.log_contains("landmarks are not stored"));
    after.wait();
    EXPECT_TRUE(after.harness.log_contains("2 landmarks are not stored: more than 10 came before"));
  }
  const LandmarkStore store(where());
  EXPECT_EQ(store.size(), 15U) << "five of before";
  std::set<std::int64_t> stamps;
  for (const auto& landmark : store.landmarks()) stamps.insert(landmark.stamp_ns);
  for (std::uint32_t id = 5; id < 17; ++id) EXPECT_EQ(stamps.contains(at_once(id).stamp_ns), id >= 7) << id;
}

TEST_P(StoreRestartedAlone, MovesNoLandmarkToThePlaceOfAnotherOfTheSameId) {
  const auto other = with_id(1, made_up_landmark(10));  // built before the store was there
  const auto first = made_up_landmark(1);
  for (const bool are_poses_first : {false, true}) {
    Life after(where(), "after");
    after.wait();
    if (are_poses_first) after.publish_poses({other});
    after.publish(other);
    after.publish_poses({moved_by(1.0, other)});
  }
  EXPECT_EQ(x_of(1), first.map_from_base.translation().x());
  {
    Life after(where(), "after");
    after.wait();
    after.publish(other);
    after.publish_poses({moved_by(1.0, first)});  // the localizer has heard of the store's one first
  }
  EXPECT_EQ(x_of(1), first.map_from_base.translation().x() + 1.0);
}

/// In a database that robots share.
class StoreRestartedBesideOthers : public ServerTest {};

TEST_F(StoreRestartedBesideOthers, WaitsForNoRunOfAnotherRobot) {
  {
    LandmarkStore store(location(), made_up_settings());
    store.add(made_up_landmark(1));
    store.begin_run({"before/other_robot/landmarks", 1, 0, {}});
    store.add(with_id(1, made_up_landmark(30)), IfTaken::kNextId);
  }
  const Life after(StoreLocation(location()), "after");
  EXPECT_THAT(after.distinct_ids(), UnorderedElementsAre(Pair(1U, stamp_of(1)), Pair(2U, stamp_of(30))));
}

}  // namespace
}  // namespace panvo::landmarks
