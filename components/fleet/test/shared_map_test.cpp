// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/shared_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "made_up_maps.hpp"

namespace panvo::fleet {
namespace {

using Applied = SharedMap::Applied;

class AMapAndItsReplica : public testing::Test {
 protected:
  /// Everything that happened since the version that was sent last.
  MapChanges send() {
    auto changes = owner_.since(sent_, 100, 100);
    EXPECT_TRUE(changes);
    sent_ = changes->version;
    return *changes;
  }
  void expect_equal() const {
    EXPECT_EQ(replica_.version(), owner_.version());
    EXPECT_EQ(replica_.digest(), owner_.digest());
    ASSERT_EQ(replica_.places().size(), owner_.places().size());
    for (const auto& [id, place] : owner_.places()) {
      EXPECT_TRUE(replica_.find(id)->map_from_base.isApprox(place.landmark.map_from_base)) << id;
      EXPECT_EQ(replica_.find(id)->description, place.landmark.description) << id;
    }
    EXPECT_EQ(replica_.sightings().size(), owner_.sightings().size());
  }
  void move(std::uint32_t id, double x) {
    ASSERT_EQ(owner_.move({{id, flat(x, 1.0, 0.0), covariance_of(0.1, 0.01)}}, 0.01, 0.01), 1U);
  }

  SharedMap owner_{7, 1, 100}, replica_{7, 1, 100};
  std::uint64_t sent_ = 0;
};

TEST_F(AMapAndItsReplica, AreEqualAfterEachChange) {
  owner_.add(place_at(1, flat(0, 0, 0)));
  EXPECT_EQ(replica_.apply(send()), Applied::kApplied);
  expect_equal();
  owner_.add(place_at(2, flat(10, 0, 0)));
  owner_.add(Sighting{0, 1, {9, 3}, flat(1, 0, 0), covariance_of(0.1, 0.1), 20, 5.0});
  EXPECT_EQ(replica_.apply(send()), Applied::kApplied);
  move(1, 0.5);
  EXPECT_EQ(replica_.apply(send()), Applied::kApplied);
  expect_equal();
}

TEST_F(AMapAndItsReplica, IgnoreWhatComesTwiceOrLate) {
  owner_.add(place_at(1, flat(0, 0, 0)));
  const auto first = send();
  move(1, 5.0);
  const auto second = send();
  replica_.apply(first);
  replica_.apply(second);
  EXPECT_EQ(replica_.apply(second), Applied::kOld);
  EXPECT_EQ(replica_.apply(first), Applied::kOld);
  expect_equal();
}

TEST_F(AMapAndItsReplica, NoticeALossAndCatchUpWithOneRequest) {
  owner_.add(place_at(1, flat(0, 0, 0)));
  replica_.apply(send());
  owner_.add(place_at(2, flat(10, 0, 0)));
  send();  // lost
  move(1, 0.5);
  EXPECT_EQ(replica_.apply(send()), Applied::kGap);
  EXPECT_EQ(replica_.places().size(), 1U) << "changed nothing";
  EXPECT_DOUBLE_EQ(replica_.find(1)->map_from_base.translation().x(), 0.0);
  EXPECT_EQ(replica_.apply(*owner_.since(replica_.version(), 100, 100)), Applied::kApplied);
  expect_equal();
}

TEST_F(AMapAndItsReplica, AreServedByTheRepetitionForAnother) {
  for (std::uint32_t id = 1; id <= 3; ++id) {
    owner_.add(place_at(id, flat(10.0 * id, 0, 0)));
    replica_.apply(send());
  }
  owner_.add(place_at(4, flat(40, 0, 0)));
  SharedMap late(7, 1, 100);
  const auto all = owner_.since(0, 100, 100);  // for a robot that has just come
  EXPECT_EQ(late.apply(*all), Applied::kApplied);
  EXPECT_EQ(replica_.apply(*all), Applied::kApplied) << "it brings place 4, which was not sent yet";
  expect_equal();
  EXPECT_EQ(late.digest(), owner_.digest());
}

TEST_F(AMapAndItsReplica, AreEqualAfterPartsOfAnyOrder) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 20; ++trial) {
    SharedMap owner(7, 1, 1000), replica(7, 1, 1000);
    std::vector<MapChanges> sent;
    std::uint64_t until = 0;
    for (std::uint32_t id = 1; id <= 40; ++id) {
      owner.add(place_at(id, flat(id, 0, 0)));
      owner.move({{1 + static_cast<std::uint32_t>(random() % id), flat(id, 9, 0), covariance_of(1, 1)}}, 0.0, 0.0);
      if (random() % 3 != 0) continue;
      for (; until < owner.version(); until = sent.back().version) sent.push_back(*owner.since(until, 3, 3));
    }
    std::shuffle(sent.begin(), sent.end(), random);
    for (const auto& changes : sent) {
      if (random() % 4 != 0) replica.apply(changes);  // a quarter is lost
    }
    for (int requests = 0; replica.version() < owner.version(); ++requests) {
      ASSERT_LT(requests, 100);
      EXPECT_EQ(replica.apply(*owner.since(replica.version(), 3, 3)), Applied::kApplied);
    }
    EXPECT_EQ(replica.digest(), owner.digest());
    EXPECT_EQ(replica.places().size(), 40U);
  }
}

TEST_F(AMapAndItsReplica, KeepTheDescriptionOfAPlaceThatMovedBeforeItWasRepeated) {
  owner_.add(place_at(1, flat(0, 0, 0)));
  owner_.add(place_at(2, flat(10, 0, 0)));
  move(1, 0.5);
  // in two parts: the place is described in the first one, although its last change is in the second
  EXPECT_EQ(replica_.apply(*owner_.since(0, 1, 1)), Applied::kApplied);
  EXPECT_LT(replica_.version(), owner_.version());
  while (replica_.version() < owner_.version()) replica_.apply(*owner_.since(replica_.version(), 1, 1));
  expect_equal();
}

TEST_F(AMapAndItsReplica, SendAPlaceAgainOnlyIfItMoved) {
  owner_.add(place_at(1, flat(0, 0, 0)));
  EXPECT_EQ(owner_.move({{1, flat(0.04, 0, 0.001), covariance_of(0.02, 0.001)}}, 0.05, 0.01), 0U);
  EXPECT_EQ(owner_.version(), 1U);
  EXPECT_EQ(owner_.move({{1, flat(0.06, 0, 0.0), covariance_of(0.02, 0.001)}}, 0.05, 0.01), 1U);
  EXPECT_EQ(owner_.move({{5, flat(0.06, 0, 0.0), covariance_of(0.02, 0.001)}}, 0.05, 0.01), 0U) << "unknown";
}

TEST_F(AMapAndItsReplica, DifferInTheirDigestIfTheirContentsDo) {
  owner_.add(place_at(1, flat(0, 0, 0)));
  auto other = place_at(1, flat(0, 0, 0));
  other.description.large[0].value = 0.6F;
  replica_.add(other);
  EXPECT_NE(owner_.digest(), replica_.digest());
}

TEST_F(AMapAndItsReplica, RefuseMorePlacesThanAllowed) {
  SharedMap small(7, 1, 2);
  for (std::uint32_t id = 1; id <= 3; ++id) owner_.add(place_at(id, flat(id, 0, 0)));
  EXPECT_EQ(small.apply(*owner_.since(0, 100, 100)), Applied::kFull);
  EXPECT_TRUE(small.places().empty());
}

TEST(MapIds, AreThoseOfTheRobotAndTheFirstPlace) {
  const auto place = place_at(1, flat(0, 0, 0));
  auto tomorrow = place;
  tomorrow.stamp_ns += 86'400'000'000'000;
  auto moved = place;
  moved.map_from_base = flat(0.3, 0, 0);
  EXPECT_NE(map_id("one", place), map_id("two", place));
  EXPECT_NE(map_id("one", place), map_id("one", tomorrow));
  EXPECT_EQ(map_id("one", place), map_id("one", moved)) << "a stored map keeps its id";
}

}  // namespace
}  // namespace panvo::fleet
