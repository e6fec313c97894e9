// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/large_scale_index.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "large_scale_kernels.hpp"
#include "painted_panorama.hpp"
#include "panvo/landmarks/landmark_distance.hpp"

namespace panvo::landmarks {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

constexpr std::uint32_t kPlaces = 40;

const PanoramaDescriber& describer() {
  static const PanoramaDescriber one({}, 1);
  return one;
}

/// Descriptions of painted places 1, 2, ...
const std::vector<PanoramaDescription>& places() {
  static const std::vector<PanoramaDescription> all = [] {
    std::vector<PanoramaDescription> descriptions;
    for (unsigned i = 1; i <= kPlaces; ++i) descriptions.push_back(describer().describe(paint_panorama(i)));
    return descriptions;
  }();
  return all;
}

/// Of the places, with ids 100, 99, ...
LargeScaleIndex index_of_places() {
  LargeScaleIndex index;
  for (std::uint32_t i = 0; i < kPlaces; ++i) index.add(100 - i, places()[i]);
  return index;
}

bool everyone(std::uint32_t) { return true; }

/// Another day at a place, turned: darker, and a part of the view is covered.
QueryDescription seen_again(unsigned place) {
  cv::Mat panorama = turn_left(paint_panorama(place), 200);
  panorama.colRange(300, 420).setTo(60);
  return describer().query(0.8 * panorama);
}

TEST(LargeScaleIndex, RanksAsTheExactDistanceDoes) {
  const auto index = index_of_places();
  for (const unsigned place : {3U, 17U, 40U}) {
    const auto query = seen_again(place);
    const auto ranking = index.rank(query, kPlaces, everyone);
    EXPECT_EQ(ranking.asked, kPlaces);
    ASSERT_THAT(ranking.nearest, SizeIs(kPlaces));
    EXPECT_EQ(ranking.nearest.front().id, 101 - place);
    for (const auto& ranked : ranking.nearest) {
      EXPECT_NEAR(ranked.distance, match_large_scale(query, places()[100 - ranked.id]).distance, 0.03) << ranked.id;
    }
    for (std::size_t i = 1; i < kPlaces; ++i) {
      EXPECT_LE(ranking.nearest[i - 1].distance, ranking.nearest[i].distance);
    }
  }
}

TEST(LargeScaleIndex, ReturnsTheMostSimilarOnesOfThoseThatAreAsked) {
  const auto index = index_of_places();
  const auto query = seen_again(3);
  const auto all = index.rank(query, kPlaces, everyone).nearest;
  const auto ranking = index.rank(query, 2, [&](std::uint32_t id) { return id != all[0].id && id != all[2].id; });
  EXPECT_EQ(ranking.asked, kPlaces - 2);
  ASSERT_THAT(ranking.nearest, SizeIs(2));
  EXPECT_EQ(ranking.nearest[0].id, all[1].id);
  EXPECT_EQ(ranking.nearest[1].id, all[3].id);
}

TEST(LargeScaleIndex, FindsAPlaceAmongMoreThanItComparesByAllFeatures) {
  LargeScaleIndex index = index_of_places();
  for (std::uint32_t copy = 1; copy <= 200; ++copy) {  // 7,960 others
    for (std::uint32_t i = 0; i < kPlaces; ++i) {
      if (i != 6) index.add(1000 * copy + i, places()[i]);
    }
  }
  EXPECT_EQ(index.rank(seen_again(7), 5, everyone).nearest.front().id, 94U);
}

TEST(LargeScaleIndex, PutsLandmarksWithoutFeaturesLast) {
  LargeScaleIndex index;
  EXPECT_TRUE(index.rank(seen_again(1), 5, everyone).nearest.empty());
  index.add(1, {});
  index.add(2, places()[0]);
  const auto ranking = index.rank(seen_again(1), 5, everyone);
  ASSERT_THAT(ranking.nearest, SizeIs(2));
  EXPECT_EQ(ranking.nearest[0].id, 2U);
  EXPECT_EQ(ranking.nearest[1].distance, 1.0F);
}

TEST(LargeScaleIndex, CountsNoWeightThatBreaksTheRules) {
  auto broken = places()[0];
  broken.large.resize(10);
  LargeScaleIndex index;
  index.add(1, broken);
  for (const float weight : {-0.02F, -1e30F, -INFINITY, NAN}) broken.large.push_back({0, 4.0F, 0.1F, weight});
  index.add(2, broken);
  const auto nearest = index.rank(seen_again(1), 2, everyone).nearest;
  ASSERT_THAT(nearest, SizeIs(2));
  EXPECT_LT(nearest[0].distance, 1.0F);
  EXPECT_EQ(nearest[0].distance, nearest[1].distance);
}

TEST(LargeScaleIndex, OrdersEqualLandmarksById) {
  LargeScaleIndex index;
  for (const std::uint32_t id : {5U, 2U, 9U}) index.add(id, places()[0]);
  const auto nearest = index.rank(seen_again(1), 2, everyone).nearest;
  ASSERT_THAT(nearest, SizeIs(2));
  EXPECT_EQ(nearest[0].id, 2U);
  EXPECT_EQ(nearest[1].id, 5U);
}

/// Terms as their definition says.
std::vector<std::uint16_t> sums_of(const std::vector<IndexedFeature>& features,
                                   const std::vector<std::int16_t>& responses, std::size_t stride) {
  std::vector<std::uint16_t> sums(stride);
  for (const auto& feature : features) {
    for (std::size_t i = 0; i < stride; ++i) {
      const auto difference = static_cast<std::uint32_t>(std::abs(responses[feature.row * stride + i] - feature.value));
      const auto term = std::min<std::uint32_t>(feature.cap, (difference * feature.factor) >> 16);
      sums[i] = static_cast<std::uint16_t>(std::min<std::uint32_t>(65535, sums[i] + term));
    }
  }
  return sums;
}

TEST(LargeScaleKernels, AddTheSameTermsWithEachInstructionSet) {
  std::vector kernels{&kLargeScalePlain};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) kernels.push_back(&kLargeScaleAvx2);
#endif
  std::mt19937_64 random(1);
  constexpr std::size_t kRows = 20;
  for (const std::size_t stride : {16U, 32U, 48U, 112U}) {
    std::vector<std::int16_t> responses(kRows * stride);
    for (auto& response : responses) response = static_cast<std::int16_t>(random() % 65535 - 32767);
    responses[0] = 32767;
    responses[1] = -32767;
    std::vector<IndexedFeature> features;
    for (int i = 0; i < 90; ++i) {
      features.push_back({static_cast<std::uint16_t>(random() % kRows),
                          static_cast<std::int16_t>(random() % 65535 - 32767), static_cast<std::uint16_t>(random()),
                          static_cast<std::uint16_t>(random() % 500)});
    }
    features.push_back({0, -32767, 65535, 65535});
    for (const auto* kernel : kernels) {
      ASSERT_EQ(stride % kernel->lanes, 0U);
      std::vector<std::uint16_t> sums(stride);
      kernel->add_terms(features, responses.data(), sums);
      EXPECT_EQ(sums, sums_of(features, responses, stride)) << kernel->lanes << " lanes, " << stride << " headings";
    }
  }
}

}  // namespace
}  // namespace panvo::landmarks
