// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/sighting_run.hpp"

#include <gtest/gtest.h>

#include "panvo/vision/angle.hpp"

namespace panvo::stereo_places {
namespace {

Eigen::Isometry3d at(double x_m, double y_m = 0.0, double yaw_rad = 0.0) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
  pose.translation() << x_m, y_m, 0.0;
  return pose;
}

/// Landmark i stands at x = 10 i; the odometry began elsewhere and turned.
class SightingRunTest : public testing::Test {
 protected:
  void see(std::uint32_t id, double x_m, double wrong_m = 0.0) {
    const Eigen::Isometry3d odom_from_map = at(3.0, 4.0, 1.0);
    const Eigen::Isometry3d base = at(x_m);
    run.add({stamp_ns += 400'000'000, id, at(10.0 * id).inverse() * at(x_m + wrong_m), odom_from_map * base, x_m},
            [](std::uint32_t landmark) -> std::optional<Eigen::Isometry3d> {
              return landmark > 100 ? std::nullopt : std::optional(at(10.0 * landmark));
            });
  }
  SightingRun run{RunParameters{}};
  std::int64_t stamp_ns = 0;
};

TEST_F(SightingRunTest, IsConfirmedByThreeSightingsOverTwoMetres) {
  see(1, 9.0);
  EXPECT_FALSE(run.is_confirmed(true));
  see(1, 10.0);
  EXPECT_FALSE(run.is_confirmed(true));
  see(1, 11.0);
  EXPECT_TRUE(run.is_confirmed(true));
  EXPECT_FALSE(run.is_confirmed(false));
}

TEST_F(SightingRunTest, IsNotConfirmedAtStandstill) {
  for (int i = 0; i < 10; ++i) see(1, 9.0);
  EXPECT_FALSE(run.is_confirmed(true));
}

TEST_F(SightingRunTest, GoesOnWithTheNextLandmark) {
  for (const double x_m : {9.0, 11.0}) see(1, x_m);
  for (const double x_m : {13.0, 15.0, 17.0}) see(2, x_m);
  EXPECT_EQ(run.sightings(), 5);
  EXPECT_TRUE(run.is_confirmed(false));
}

TEST_F(SightingRunTest, BeginsAnewWithASightingThatContradictsTheOdometry) {
  for (const double x_m : {9.0, 10.0}) see(1, x_m);
  see(2, 11.0, 1.0);
  EXPECT_EQ(run.sightings(), 1);
  see(2, 12.0, 2.0);  // an equal street that passes by twice as fast
  EXPECT_EQ(run.sightings(), 1);
}

TEST_F(SightingRunTest, ForgetsAfterAWhile) {
  see(1, 9.0);
  EXPECT_EQ(run.landmark(10.0), 1U);
  EXPECT_EQ(run.landmark(30.0), std::nullopt);
  see(3, 30.0);
  EXPECT_EQ(run.sightings(), 1);
}

TEST_F(SightingRunTest, DoesNotTrustALandmarkThatIsGone) {
  see(101, 9.0);
  see(101, 10.0);
  EXPECT_EQ(run.sightings(), 1);
}

TEST(SightingRun, CountsATurnOnTheSpotAsPath) {
  SightingRun run{RunParameters{}};
  for (int i = 0; i < 3; ++i) {
    const auto pose = at(0.0, 0.0, 12.0 * vision::kDegree * i);
    run.add({i, 1, pose, pose, 0.0}, [](std::uint32_t) { return std::optional(at(0.0)); });
  }
  EXPECT_TRUE(run.is_confirmed(true));
}

}  // namespace
}  // namespace panvo::stereo_places
