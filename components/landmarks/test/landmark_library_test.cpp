// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/landmark_library.hpp"
#include "panvo/interfaces/place_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "made_up_landmark.hpp"

namespace panvo::landmarks {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

PanoramicLandmark at(double x, double y, std::uint32_t id = 0) {
  PanoramicLandmark landmark;
  landmark.id = id;
  landmark.map_from_base.translation() = Eigen::Vector3d(x, y, 0.0);
  return landmark;
}

template <class Landmarks>
std::vector<std::uint32_t> ids(const Landmarks& landmarks) {
  std::vector<std::uint32_t> found;
  for (const auto* landmark : landmarks) found.push_back(landmark->id);
  return found;
}

TEST(LandmarkLibrary, TakesNoDescriptionThatItsMatricesCannotBeComparedWith) {
  LandmarkLibrary library(nullptr, {.rows = 800, .bins = 64});
  PanoramicLandmark landmark;
  landmark.description.histogram.assign(64, 1.0F / 64.0F);
  landmark.description.large.push_back({.row = 799});
  EXPECT_EQ(library.add(landmark), 1U);
  for (auto* features : {&landmark.description.large, &landmark.description.small}) {
    features->push_back({.row = 800});
    EXPECT_THROW(library.add(landmark), std::invalid_argument);
    features->pop_back();
  }
  landmark.description.histogram = {1.0F};
  EXPECT_THROW(library.add(landmark), std::invalid_argument);
}

TEST(LandmarkLibrary, NumbersLandmarksFromOneOn) {
  LandmarkLibrary library;
  EXPECT_EQ(library.next_id(), 1u);
  EXPECT_EQ(library.add(at(0, 0)), 1u);
  EXPECT_EQ(library.add(at(0, 0)), 2u);
  EXPECT_EQ(library.add(at(0, 0, 9)), 9u);
  EXPECT_EQ(library.add(at(0, 0)), 10u);
  EXPECT_EQ(library.size(), 4u);
}

TEST(LandmarkLibrary, EndsAtTheHighestId) {
  LandmarkLibrary library;
  EXPECT_THROW(library.add(at(0, 0, interfaces::kMaxLandmarkId + 1)), std::invalid_argument);
  library.add(at(0, 0, interfaces::kMaxLandmarkId));
  EXPECT_NE(library.next_id(), 0u);
  EXPECT_THROW(library.add(at(0, 0)), std::invalid_argument);
}

TEST(LandmarkLibrary, ListsByIdWhateverTheOrderOfArrival) {
  LandmarkLibrary library;
  for (const std::uint32_t id : {5u, 2u, 9u, 1u}) library.add(at(id, 0, id));
  EXPECT_THAT(ids(library.all()), ElementsAre(1, 2, 5, 9));
  EXPECT_THAT(ids(library.within(Eigen::Vector3d::Zero(), kInfinite)), ElementsAre(1, 2, 5, 9));
  EXPECT_THAT(ids(library.within(Eigen::Vector3d::Zero(), 6.0)), ElementsAre(1, 2, 5));
}

TEST(LandmarkLibrary, FindsByIdAndKeepsLandmarksWhereTheyAre) {
  LandmarkLibrary library;
  library.add(at(1, 2, 7));
  const auto* found = library.find(7);
  for (int i = 0; i < 1000; ++i) library.add(at(i, 0));
  EXPECT_EQ(library.find(7), found);
  EXPECT_EQ(found->map_from_base.translation().y(), 2.0);
  EXPECT_EQ(library.find(6), nullptr);
  EXPECT_EQ(library.find(0), nullptr);
}

TEST(LandmarkLibrary, RefusesATakenIdAndAPoseThatIsNone) {
  LandmarkLibrary library;
  library.add(at(0, 0, 3));
  EXPECT_THAT(test::error_of<std::invalid_argument>([&] { library.add(at(1, 1, 3)); }),
              HasSubstr("landmark 3 is already in the library"));
  EXPECT_THAT(test::error_of<std::invalid_argument>([&] { library.add(at(kInfinite, 1)); }), HasSubstr("not finite"));
  EXPECT_EQ(library.size(), 1u);
}

// [Lu2015 5.1]: the landmarks around an uncertain position, compared with an exhaustive search.
TEST(LandmarkLibrary, FindsWithinARadiusWhatASearchOfAllFinds) {
  LandmarkLibrary library;
  for (std::uint32_t id = 1; id <= 2000; ++id) library.add(test::made_up_landmark(id, 0, 2000.0));
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 300; ++trial) {
    const Eigen::Vector3d position{2400.0 * (test::share(random) - 0.5), 2400.0 * (test::share(random) - 0.5), 50.0};
    const double radius = std::pow(10.0, 4.0 * test::share(random) - 0.5);
    std::vector<std::uint32_t> expected;
    for (const auto* landmark : library.all()) {
      if ((landmark->map_from_base.translation() - position).head<2>().norm() <= radius) {
        expected.push_back(landmark->id);
      }
    }
    EXPECT_EQ(ids(library.within(position, radius)), expected) << radius;
  }
}

TEST(LandmarkLibrary, FindsTheNearestThatASearchOfAllFinds) {
  LandmarkLibrary library;
  for (std::uint32_t id = 1; id <= 300; ++id) library.add(test::made_up_landmark(id, 0, 2000.0));
  std::mt19937_64 random(6);
  for (int trial = 0; trial < 300; ++trial) {
    const double extent = trial % 10 == 0 ? 1e7 : 3000.0;
    const Eigen::Vector3d position{extent * (test::share(random) - 0.5), extent * (test::share(random) - 0.5), 0.0};
    double expected = kInfinite;
    for (const auto* landmark : library.all()) {
      expected = std::min(expected, (landmark->map_from_base.translation() - position).head<2>().norm());
    }
    const auto found = library.nearest(position);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->distance_m, expected);
  }
}

TEST(LandmarkLibrary, TakesTwoLandmarksAtOnePlaceAndTellsThatOneIsThere) {
  LandmarkLibrary library;
  const auto here = at(10, 20);
  EXPECT_FALSE(library.nearest(here.map_from_base.translation()));
  library.add(here);
  EXPECT_EQ(library.nearest(here.map_from_base.translation())->distance_m, 0.0);
  library.add(here);
  EXPECT_THAT(ids(library.within(here.map_from_base.translation(), 0.0)), ElementsAre(1, 2));
  EXPECT_EQ(library.nearest(here.map_from_base.translation())->landmark->id, 1u);
}

TEST(LandmarkLibrary, FindsALandmarkWhereItWasMovedTo) {
  LandmarkLibrary library;
  for (int i = 0; i < 100; ++i) library.add(at(i * 50.0, 0.0));
  auto moved = Eigen::Isometry3d::Identity();
  moved.translation() = Eigen::Vector3d(-5000.0, 7000.0, 1.0);
  EXPECT_TRUE(library.set_pose(40, moved, Eigen::Matrix<double, 6, 6>::Identity()));
  EXPECT_THAT(ids(library.within(moved.translation(), 1.0)), ElementsAre(40));
  EXPECT_THAT(ids(library.within({39 * 50.0, 0.0, 0.0}, 10.0)), IsEmpty());
  EXPECT_EQ(library.nearest(moved.translation())->landmark->id, 40u);
  EXPECT_EQ(library.find(40)->covariance(0, 0), 1.0);
  moved.translation() = Eigen::Vector3d(-4975.0, 7000.0, 1.0);  // into the next cell: it must not be found twice
  EXPECT_TRUE(library.set_pose(40, moved, Eigen::Matrix<double, 6, 6>::Identity()));
  EXPECT_THAT(ids(library.within(moved.translation(), 60.0)), ElementsAre(40));
  EXPECT_FALSE(library.set_pose(101, moved, Eigen::Matrix<double, 6, 6>::Identity()));
}

TEST(LandmarkLibrary, HasNothingWithinWhatIsNoRadiusOrNoPosition) {
  LandmarkLibrary library;
  library.add(at(0, 0));
  EXPECT_THAT(library.within(Eigen::Vector3d::Zero(), -1.0), IsEmpty());
  EXPECT_THAT(library.within(Eigen::Vector3d::Zero(), std::nan("")), IsEmpty());
  EXPECT_THAT(library.within({std::nan(""), 0.0, 0.0}, 1.0), IsEmpty());
  EXPECT_FALSE(library.nearest({kInfinite, 0.0, 0.0}));
}

/// Returns keypoints and descriptions that encode the landmark's id.
class CountingSource final : public LandmarkSource {
 public:
  std::vector<Keypoint> keypoints(std::uint32_t id) const override {
    std::vector<Keypoint> keypoints(2);
    keypoints[0].size_px = static_cast<float>(id);
    return keypoints;
  }
  PanoramaDescription description(std::uint32_t id) const override { return {{static_cast<float>(id)}, {}, {}}; }
};

TEST(LandmarkLibrary, KeepsKeypointsAndDescriptionsOnlyWhereItHasNoSource) {
  const auto landmark = test::made_up_landmark(4, 10);
  LandmarkLibrary alone;
  alone.add(landmark);
  EXPECT_EQ(alone.keypoints(4), landmark.keypoints);
  EXPECT_EQ(alone.find(4)->thumbnail, landmark.thumbnail);
  EXPECT_THAT(alone.keypoints(5), IsEmpty());
  EXPECT_EQ(alone.description(4), landmark.description);
  EXPECT_EQ(alone.description(5), PanoramaDescription());

  LandmarkLibrary with_source(std::make_shared<CountingSource>());
  with_source.add(landmark);
  EXPECT_THAT(with_source.find(4)->keypoints, IsEmpty());
  EXPECT_THAT(with_source.find(4)->thumbnail, IsEmpty());
  EXPECT_EQ(with_source.find(4)->keypoints.capacity() + with_source.find(4)->thumbnail.capacity(), 0U)
      << "memory must be released";
  EXPECT_EQ(with_source.keypoints(4).at(0).size_px, 4.0f);
  EXPECT_EQ(with_source.find(4)->description, PanoramaDescription());
  EXPECT_THAT(with_source.description(4).histogram, ElementsAre(4.0F));
}

}  // namespace
}  // namespace panvo::landmarks
