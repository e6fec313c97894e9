// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/place_ranking.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "made_up_keypoints.hpp"

namespace panvo::stereo_places {
namespace {

const auto kAll = [](std::uint32_t) { return true; };

PlaceRanking ranking_of(unsigned places) {
  PlaceRanking ranking;
  for (unsigned id = 1; id <= places; ++id) ranking.add(id, made_up_place(id));
  return ranking;
}

TEST(PlaceRanking, PutsThePlaceOfTheViewFirst) {
  const auto ranking = ranking_of(200);
  for (const unsigned id : {1U, 77U, 200U}) {
    const auto ranked = ranking.rank(seen_from(made_up_place(id), moved(1.0)), kAll, 5);
    ASSERT_EQ(ranked.size(), 5U);
    EXPECT_EQ(ranked[0].id, id);
    EXPECT_GT(ranked[0].score, 3.0 * ranked[1].score);
  }
}

TEST(PlaceRanking, FindsAPlaceOfWhichTheViewShowsAThird) {
  const auto ranking = ranking_of(200);
  auto view = seen_from(made_up_place(5), moved(1.0));
  const auto others = made_up_place(999);
  std::copy(others.begin() + 40, others.end(), view.begin() + 40);
  EXPECT_EQ(ranking.rank(view, kAll, 3).at(0).id, 5U);
}

TEST(PlaceRanking, RanksOnlyWhatIsAskedFor) {
  const auto ranking = ranking_of(20);
  const auto view = seen_from(made_up_place(5), moved(1.0));
  for (const auto& one : ranking.rank(
           view, [](std::uint32_t id) { return id > 5; }, 100))
    EXPECT_GT(one.id, 5U);
  EXPECT_TRUE(ranking
                  .rank(
                      view, [](std::uint32_t) { return false; }, 100)
                  .empty());
}

TEST(PlaceRanking, RefusesAnIdTwice) {
  auto ranking = ranking_of(1);
  EXPECT_THROW(ranking.add(1, made_up_place(3)), std::invalid_argument);
}

TEST(PlaceRanking, KnowsNothingWithoutPlaces) { EXPECT_TRUE(PlaceRanking().rank(made_up_place(1), kAll, 5).empty()); }

}  // namespace
}  // namespace panvo::stereo_places
