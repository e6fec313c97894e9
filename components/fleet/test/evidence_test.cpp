// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/evidence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "made_up_maps.hpp"

namespace panvo::fleet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Evidence, ReportsJoinsThatAreMadeAndUndone) {
  TwoMaps maps;
  Evidence evidence({});
  for (const std::uint32_t id : {1U, 2U, 3U}) maps.a_sees(id, id, flat(0.0, 30.0, 0.0));
  evidence.update({&maps.a, &maps.b}, 4);
  ASSERT_NE(evidence.find(TwoMaps::kB, TwoMaps::kA), nullptr);
  EXPECT_TRUE(evidence.find(TwoMaps::kB, TwoMaps::kA)->is_joined);
  EXPECT_THAT(evidence.take_news(), ElementsAre(HasSubstr("are joined: 3 of 3 sightings agree")));
  for (const std::uint32_t id : {6U, 7U, 8U}) maps.a_sees(id, id);
  evidence.update({&maps.a, &maps.b}, 4);
  EXPECT_FALSE(evidence.find(TwoMaps::kA, TwoMaps::kB)->is_joined);
  EXPECT_THAT(evidence.take_news(), ElementsAre(HasSubstr("was undone: 3 sightings agree, 3 others contradict")));
  EXPECT_EQ(evidence.made(), 1);
  EXPECT_EQ(evidence.undone(), 1);
}

TEST(Evidence, DoesNotLetAMapThatChangesAllTheTimeKeepOthersWaiting) {
  TwoMaps maps;
  SharedMap restless(5, 1, 1000);
  Evidence evidence({});
  for (const std::uint32_t id : {1U, 2U, 3U}) maps.a_sees(id, id);
  for (std::uint32_t i = 1; i <= 4; ++i) {
    restless.add(place_at(i, flat(i, 0, 0)));
    evidence.update({&restless, &maps.a, &maps.b}, 1);
  }
  ASSERT_NE(evidence.find(TwoMaps::kA, TwoMaps::kB), nullptr);
  EXPECT_TRUE(evidence.find(TwoMaps::kA, TwoMaps::kB)->is_joined);
}

TEST(Evidence, ForgetsMapsThatAreGone) {
  TwoMaps maps;
  Evidence evidence({});
  evidence.update({&maps.a, &maps.b}, 4);
  EXPECT_NE(evidence.find(TwoMaps::kA, TwoMaps::kB), nullptr);
  evidence.update({&maps.a}, 4);
  EXPECT_EQ(evidence.find(TwoMaps::kA, TwoMaps::kB), nullptr);
}

TEST(Evidence, GivesTheTransformOfTheOwnMapFirst) {
  TwoMaps maps;
  Evidence evidence({});
  for (const std::uint32_t id : {1U, 2U, 3U}) maps.a_sees(id, id);
  evidence.update({&maps.a, &maps.b}, 4);
  const auto pairs = evidence.joined({&maps.a, &maps.b}, TwoMaps::kB, 2);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].a, TwoMaps::kB);
  EXPECT_LT(vision::pose_error(pairs[0].transform.a_from_b, maps.a_from_b().inverse()).norm(), 1e-9);
  EXPECT_EQ(evidence.joined_maps({&maps.a, &maps.b}, {}).size(), 1U);
  EXPECT_TRUE(evidence.joined_maps({&maps.a, &maps.b}, {{TwoMaps::kB, TwoMaps::kA}}).empty());
}

}  // namespace
}  // namespace panvo::fleet
