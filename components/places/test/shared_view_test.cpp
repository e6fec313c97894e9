// SPDX-License-Identifier: Apache-2.0
#include "panvo/places/shared_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "made_up_view.hpp"
#include "panvo/vision/angle.hpp"

namespace panvo::places {
namespace {

using namespace test;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using vision::kDegree;

double heading_error_deg(const SharedView& view, double true_deg) {
  return vision::wrap(view.heading_rad / kDegree - true_deg, 360.0);
}

TEST(SharedView, IsFoundAtAnyHeadingAndTiltAmongWrongMatches) {
  for (const double heading_deg : {-170.0, -60.0, 0.0, 95.0}) {
    MadeUpScene scene(11);
    scene.add_things(60);
    const auto place = joined(scene.view(Isometry3d::Identity()), scene.others(60));
    const auto query = joined(scene.view(moved(heading_deg, 12.0, 0.0, 0.0)), scene.others(60));
    const auto result = find_shared_view(query, place, 2.0, {});
    ASSERT_TRUE(result.view) << result.reason;
    EXPECT_LT(std::abs(heading_error_deg(*result.view, heading_deg)), 0.3);
    EXPECT_FALSE(result.view->direction) << "nothing was travelled";
  }
}

TEST(SharedView, GivesTheDirectionOfTravelThroughThingsAtDifferentRanges) {
  MadeUpScene scene(12);
  scene.add_things(120);
  const auto place = scene.view(Isometry3d::Identity());
  const auto result = find_shared_view(scene.view(moved(70.0, 2.0, 0.9, 1.2)), place, 2.0, {});
  ASSERT_TRUE(result.view) << result.reason;
  EXPECT_EQ(result.view->model, ViewModel::kEpipolar);
  EXPECT_LT(std::abs(heading_error_deg(*result.view, 70.0)), 0.5);
  ASSERT_TRUE(result.view->direction);
  EXPECT_LT(std::acos(result.view->direction->dot(Vector3d(0.6, 0.0, 0.8))), 3.0 * kDegree);
  EXPECT_NEAR(result.view->baseline_per_range, 1.5 / 7.0, 0.06) << "1.5 m among things 2 to 12 m away";
}

TEST(SharedView, StatesHeadingErrorsThatItsSigmaCovers) {
  int outside = 0;
  constexpr int kScenes = 20;
  for (int i = 0; i < kScenes; ++i) {
    MadeUpScene scene(100 + static_cast<std::uint64_t>(i));
    scene.add_things(80);
    const auto place = scene.view(Isometry3d::Identity(), 0.4);
    const auto result = find_shared_view(scene.view(moved(40.0, 3.0, 0.5, -0.4), 0.4), place, 2.0, {});
    ASSERT_TRUE(result.view) << result.reason;
    const double sigma_deg = result.view->heading_sigma_rad / kDegree;
    EXPECT_LT(sigma_deg, 1.0);
    outside += std::abs(heading_error_deg(*result.view, 40.0)) > 2.5 * sigma_deg ? 1 : 0;
  }
  EXPECT_LE(outside, 2);
}

TEST(SharedView, IsNotFoundAmongWrongMatchesOnly) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    MadeUpScene scene(20 + seed);
    scene.add_things(150);
    // the same looks at other bearings: every match is wrong
    auto query = scene.view(Isometry3d::Identity());
    const auto place = query;
    for (auto& keypoint : query) {
      const double azimuth = scene.uniform(-3.14, 3.14);
      const double flat = std::hypot(keypoint.bearing.x(), keypoint.bearing.z());
      keypoint.bearing =
          Eigen::Vector3d(flat * std::sin(azimuth), static_cast<double>(keypoint.bearing.y()), flat * std::cos(azimuth))
              .cast<float>();
    }
    const auto result = find_shared_view(query, place, 2.0, {});
    EXPECT_GT(result.matches, 50);
    EXPECT_FALSE(result.view) << "chance 1e" << result.log10_expected;
    EXPECT_THAT(result.reason, testing::HasSubstr("as by chance"));
  }
}

TEST(SharedView, IsNotFoundByOneObjectThatStandsElsewhereAgain) {
  MadeUpScene object(30);
  object.add_things(60, 20.0, 60.0);
  MadeUpScene here(31), there(32);
  const auto place = joined(object.view(Isometry3d::Identity()), here.others(100));
  const auto query = joined(object.view(moved(-50.0, 0.0, 0.3, 0.0)), there.others(100));
  const auto result = find_shared_view(query, place, 2.0, {});
  EXPECT_LT(result.log10_expected, -10.0) << "the object itself agrees";
  EXPECT_FALSE(result.view);
  EXPECT_THAT(result.reason, testing::HasSubstr("only on one object"));
}

TEST(SharedView, IsNotFoundByCloudsThatStandOverOtherPlacesToo) {
  MadeUpScene sky(50), here(51), there(52);
  sky.add_clouds(100);
  const auto place = joined(sky.view(Isometry3d::Identity()), here.others(60));
  const auto query = joined(sky.view(moved(35.0, 0.0, 50.0, 20.0)), there.others(60));
  const auto result = find_shared_view(query, place, 2.0, {});
  EXPECT_LT(result.log10_expected, -10.0) << "the sky itself agrees";
  EXPECT_FALSE(result.view);
  EXPECT_THAT(result.reason, testing::HasSubstr("the sky"));
}

TEST(SharedView, IsFoundPastABonnetThatStaysAhead) {
  MadeUpScene bonnet(40), scene(41);
  bonnet.add_things(80, -25.0, 25.0);
  scene.add_things(60);
  const auto body = bonnet.view(Isometry3d::Identity());
  const auto place = joined(scene.view(Isometry3d::Identity()), body);
  const auto query = joined(scene.view(moved(100.0, 0.0, 0.4, 0.2)), bonnet.view(Isometry3d::Identity()));
  const auto result = find_shared_view(query, place, 2.0, {});
  ASSERT_TRUE(result.view) << result.reason;
  EXPECT_LT(std::abs(heading_error_deg(*result.view, 100.0)), 1.0);
}

TEST(SharedView, IsNotFoundByTheVehicleThatIsSeenAllRoundAtAllPlaces) {
  MadeUpScene vehicle(60), sky(61), here(62), there(63), scene(64);
  vehicle.add_vehicle(40);
  sky.add_clouds(20);
  scene.add_things(60);
  const auto origin = Isometry3d::Identity();
  const auto common = joined(vehicle.view(origin), sky.view(origin));
  const auto result = find_shared_view(joined(common, there.others(60)), joined(common, here.others(60)), 2.0, {});
  EXPECT_LT(result.log10_expected, -10.0) << "vehicle and sky themselves agree";
  EXPECT_FALSE(result.view);
  EXPECT_THAT(result.reason, testing::HasSubstr("the vehicle"));
  const auto turned = scene.view(moved(100.0, 0.0, 0.4, 0.2));
  const auto again = find_shared_view(joined(common, turned), joined(common, scene.view(origin)), 2.0, {});
  ASSERT_TRUE(again.view) << again.reason;
  EXPECT_LT(std::abs(heading_error_deg(*again.view, 100.0)), 1.0);
}

TEST(SharedView, IsNotFoundInPanoramasWithoutKeypoints) { EXPECT_FALSE(find_shared_view({}, {}, 0.0, {}).view); }

}  // namespace
}  // namespace panvo::places
