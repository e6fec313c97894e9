// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/landmark_builder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "painted_town.hpp"

namespace panvo::landmark_builder {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr int kColumns = 1080;

PosedPanorama posed(const PaintedTown& town, double x) {
  const auto pose = PaintedTown::at(x, -1.5, 0.0);
  vision::Matrix6d covariance = vision::Matrix6d::Identity();
  return {static_cast<std::int64_t>(1e9 * (100.0 + x)), town.panorama(pose, kColumns), pose, 0.01 * covariance};
}

std::vector<landmarks::PanoramicLandmark> drive(LandmarkBuilder& builder, const PaintedTown& town, double from,
                                                double to, landmarks::MapReplica map = {}) {
  std::vector<landmarks::PanoramicLandmark> all;
  for (double x = from; x < to; x += 1.0) {
    for (auto& landmark : builder.step(posed(town, x), map)) all.push_back(std::move(landmark));
  }
  return all;
}

landmarks::MapReplica map_with(std::uint32_t id, const Eigen::Vector3d& position) {
  landmarks::MapReplica map;
  map.move({{id, Eigen::Isometry3d(Eigen::Translation3d(position))}});
  return map;
}

/// Median of the distances of near points over the true ones: everything lies on the ground, 2 m below the camera.
double range_ratio(const landmarks::PanoramicLandmark& landmark) {
  constexpr float kNear_m = 12.0F;
  std::vector<double> ratios;
  for (const auto& keypoint : landmark.keypoints) {
    if (!keypoint.has_point || keypoint.bearing.y() < 2.0F / kNear_m) continue;
    ratios.push_back(static_cast<double>(keypoint.point_in_panorama.norm() * keypoint.bearing.y() / 2.0F));
  }
  std::ranges::sort(ratios);
  return ratios.empty() ? 0.0 : ratios[ratios.size() / 2];
}

/// No landmark at the start of the drive.
BuilderParameters on_the_way() {
  BuilderParameters parameters;
  parameters.rule.first_m = 1000.0;
  return parameters;
}

LandmarkBuilder make_builder(const BuilderParameters& parameters = on_the_way()) {
  return {parameters, 1, PaintedTown::base_from_panorama(), {kColumns, kColumns / 2}};
}

TEST(LandmarkBuilder, MakesOneLandmarkOfACrossingWithAllItsLevels) {  // [Lu2015 4.1, 4.2]
  const PaintedTown town = PaintedTown::star({0.0, 0.5 * M_PI, M_PI, 1.5 * M_PI});
  LandmarkBuilder builder = make_builder();
  const auto built = drive(builder, town, -30.0, 25.0);
  ASSERT_THAT(built, SizeIs(1));
  const auto& landmark = built[0];
  EXPECT_EQ(landmark.id, 1U);
  EXPECT_TRUE(landmark.is_junction);
  EXPECT_LT(std::abs(landmark.map_from_base.translation().x()), 4.0);
  EXPECT_EQ(landmark.stamp_ns, static_cast<std::int64_t>(1e9 * (100.0 + landmark.map_from_base.translation().x())));
  EXPECT_DOUBLE_EQ(landmark.covariance(0, 0), 0.01);
  EXPECT_TRUE(landmark.base_from_panorama.isApprox(PaintedTown::base_from_panorama()));
  EXPECT_FALSE(landmark.description.large.empty());
  EXPECT_FALSE(landmark.description.small.empty());
  EXPECT_FALSE(landmark.thumbnail.empty());
  int right = 0, points = 0;
  for (const auto& keypoint : landmark.keypoints) {
    if (!keypoint.has_point) continue;
    ++points;
    // everything lies on the ground, 2 m below the camera
    const double true_inverse = std::max(0.0, static_cast<double>(keypoint.bearing.y())) / 2.0;
    const double inverse = 1.0 / keypoint.point_in_panorama.cast<double>().norm();
    if (std::abs(inverse - true_inverse) < 4.0 * keypoint.inverse_range_sigma) ++right;
  }
  EXPECT_GE(points, 5);
  EXPECT_GE(right, 6 * points / 10) << points;  // coarse pixels near the horizon cause some errors
}

TEST(LandmarkBuilder, MakesOneWhereANewMapBegins) {
  const PaintedTown town = PaintedTown::star({0.0, 0.5 * M_PI, M_PI, 1.5 * M_PI});
  LandmarkBuilder builder = make_builder({});
  const auto built = drive(builder, town, -30.0, 25.0);
  ASSERT_THAT(built, SizeIs(2));
  EXPECT_FALSE(built[0].is_junction);
  EXPECT_NEAR(built[0].map_from_base.translation().x(), -26.0, 1.0);
  EXPECT_TRUE(built[1].is_junction);
}

/// The panoramas of a vehicle that starts, by a clock that is late: its odometry was farther on at their stamps.
TEST(LandmarkBuilder, MakesTheFirstOfANewMapOnceTheTimesOfItsPanoramasAreKnown) {
  constexpr double kFrom_m = -30.0, kTo_m = -8.0, kTooFar = 1.1;
  const PaintedTown town = PaintedTown::star({0.0, 0.5 * M_PI, M_PI, 1.5 * M_PI});
  BuilderParameters waiting;
  waiting.rule.wait_for_clock_s = 60.0;
  LandmarkBuilder builder = make_builder(waiting);
  landmarks::MapReplica map;
  for (double x = kFrom_m; x < kTo_m; x += 1.0) {
    PosedPanorama early = posed(town, x);
    early.odom_from_base.translation().x() = kFrom_m + kTooFar * (x - kFrom_m);
    EXPECT_THAT(builder.step(early, map), IsEmpty());
  }
  builder.set_clock_known();
  builder.set_poses(
      [](std::int64_t stamp_ns) { return PaintedTown::at(1e-9 * static_cast<double>(stamp_ns) - 100.0, -1.5, 0.0); });
  const auto built = builder.step(posed(town, kTo_m), map);
  ASSERT_THAT(built, SizeIs(1));
  EXPECT_EQ(built[0].stamp_ns, static_cast<std::int64_t>(1e9 * (100.0 + built[0].map_from_base.translation().x())));
  EXPECT_NEAR(built[0].map_from_base.translation().x(), -26.0, 1.0);
  EXPECT_NEAR(range_ratio(built[0]), 1.0, 0.04);
}

TEST(LandmarkBuilder, MakesAllThatWaitedOnceTheTimesOfItsPanoramasAreKnown) {
  const PaintedTown town = PaintedTown::star({0.0, 0.5 * M_PI, M_PI, 1.5 * M_PI});
  BuilderParameters waiting;
  waiting.rule.wait_for_clock_s = 60.0;
  LandmarkBuilder builder = make_builder(waiting);
  EXPECT_THAT(drive(builder, town, -30.0, 25.0), IsEmpty());
  builder.set_clock_known();
  const auto built = drive(builder, town, 25.0, 26.0);
  ASSERT_THAT(built, SizeIs(2));
  EXPECT_NEAR(built[0].map_from_base.translation().x(), -26.0, 1.0);
  EXPECT_TRUE(built[1].is_junction);
  EXPECT_LT(std::abs(built[1].map_from_base.translation().x()), 4.0);
}

TEST(LandmarkBuilder, WaitsForTheTimesOfItsPanoramasUntilTheNextIsDue) {
  BuilderParameters waiting;
  waiting.rule.wait_for_clock_s = 60.0;
  waiting.rule.max_spacing_m = 20.0;
  LandmarkBuilder builder = make_builder(waiting);
  const auto built = drive(builder, PaintedTown::star({0.0, M_PI}), -30.0, 2.0);
  ASSERT_THAT(built, SizeIs(1)) << "another one waits now";
  EXPECT_NEAR(built[0].map_from_base.translation().x(), -26.0, 1.0);
}

TEST(LandmarkBuilder, MakesNoneWhereThePlaceWasRecognised) {
  const PaintedTown town = PaintedTown::star({0.0, 0.5 * M_PI, M_PI, 1.5 * M_PI});
  LandmarkBuilder builder = make_builder();
  auto built = drive(builder, town, -30.0, 1.0);
  builder.recognised();
  for (auto& landmark : drive(builder, town, 1.0, 25.0)) built.push_back(landmark);
  EXPECT_THAT(built, IsEmpty());
}

TEST(LandmarkBuilder, MakesNoneBesideOneThatIsThere) {
  LandmarkBuilder builder = make_builder();
  EXPECT_THAT(
      drive(builder, PaintedTown::star({0.0, 0.5 * M_PI, M_PI, 1.5 * M_PI}), -30.0, 25.0, map_with(5, {2.0, 4.0, 0.0})),
      IsEmpty());
}

TEST(LandmarkBuilder, MakesOneByDistanceWhereThereIsNoJunction) {  // [Lu2015 4.1]
  BuilderParameters parameters;
  parameters.rule.max_spacing_m = 20.0;
  LandmarkBuilder builder = make_builder(parameters);
  const auto built = drive(builder, PaintedTown::star({0.0, M_PI}), -30.0, 18.0, map_with(5, {-200.0, 0.0, 0.0}));
  ASSERT_THAT(built, SizeIs(2));
  EXPECT_EQ(built[0].id, 6U);
  EXPECT_FALSE(built[0].is_junction);
  EXPECT_NEAR((built[1].map_from_base.translation() - built[0].map_from_base.translation()).norm(), 20.0, 1.5);
}

}  // namespace
}  // namespace panvo::landmark_builder
