// SPDX-License-Identifier: Apache-2.0
#include "panvo/panoramic_compass/turn_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "panvo/vision/equirectangular.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::panoramic_compass {
namespace {

constexpr double kNoise_rad = 0.0005;

/// Points on all sides at 4 to 40 m, 35 degrees above to 6 below the horizon, seen from two positions.
class Scene {
 public:
  explicit Scene(std::uint64_t seed) : random_(seed) {}

  double between(double from, double to) {
    return from + (to - from) * static_cast<double>(random_() >> 11U) * 0x1p-53;
  }
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += between(0.0, 1.0);
    return sum;
  }
  Eigen::Vector3d direction(double from_azimuth = -std::numbers::pi, double to_azimuth = std::numbers::pi) {
    const double azimuth = between(from_azimuth, to_azimuth), elevation = between(-0.1, 0.6);
    return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
  }
  BearingPair pair(const Eigen::Vector3d& point, const Eigen::Isometry3d& now_from_then) {
    const Eigen::Vector3d noise{kNoise_rad * normal(), kNoise_rad * normal(), kNoise_rad * normal()};
    return {point.normalized(), ((now_from_then * point).normalized() + noise).normalized(),
            Eigen::Vector2d::Constant(kNoise_rad * kNoise_rad)};
  }
  std::vector<BearingPair> pairs(int count, const Eigen::Isometry3d& now_from_then) {
    std::vector<BearingPair> all;
    for (int i = 0; i < count; ++i) {
      const double range_m = between(4.0, 40.0);
      all.push_back(pair(range_m * direction(), now_from_then));
    }
    return all;
  }

 private:
  std::mt19937_64 random_;
};

/// now_from_then of a vehicle that drove `way_m`, then turned left, pitched and rolled.
Eigen::Isometry3d moved(const Eigen::Vector3d& way_m, double yaw, double pitch = 0.0, double roll = 0.0) {
  Eigen::Isometry3d then_from_now = Eigen::Isometry3d::Identity();
  then_from_now.linear() =
      (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  then_from_now.translation() = way_m;
  return then_from_now.inverse();
}

TEST(TurnFit, IsExactWhateverTheDistancesAndTheTilt) {
  Scene scene(1);
  for (const auto& way :
       {Eigen::Vector3d(1.0, 0.0, 0.0), Eigen::Vector3d(-0.5, 0.1, 0.0), Eigen::Vector3d(0.6, 0.7, 0.0)}) {
    const auto fit = fit_turn(scene.pairs(150, moved(way, 0.2, 0.02, -0.01)), vision::so3_exp({0.0, 0.0, -0.17}));
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->yaw_rad, 0.2, 4.0 * std::sqrt(fit->yaw_variance_rad2));
    EXPECT_NEAR(fit->yaw_rad, 0.2, 0.0005);
    const Eigen::Vector3d drift = -(fit->now_from_then * way).normalized();
    EXPECT_GT(fit->drift.dot(drift), 0.999);
    EXPECT_GT(fit->agreeing, 145);
  }
}

TEST(TurnFit, OfAStandingVehicleUsesAllThatThePointsTell) {
  Scene scene(2);
  const auto standing = fit_turn(scene.pairs(100, moved({0.0, 0.0, 0.0}, 0.01)), Eigen::Matrix3d::Identity());
  ASSERT_TRUE(standing);
  EXPECT_NEAR(standing->yaw_rad, 0.01, 0.0002);
  EXPECT_LT(standing->typical_parallax, 0.001);
  EXPECT_LT(standing->near_parallax, 0.001);
}

TEST(TurnFit, TellsTheDirectionFromTheFewNearPointsOfOpenLand) {
  Scene scene(6);
  const auto way = moved({1.0, 0.0, 0.0}, 0.05);
  auto pairs = scene.pairs(20, way);
  for (int i = 0; i < 180; ++i) pairs.push_back(scene.pair(1e5 * scene.direction(), way));
  const auto fit = fit_turn(pairs, Eigen::Matrix3d::Identity());
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->yaw_rad, 0.05, 0.0005);
  EXPECT_LT(fit->typical_parallax, 0.001);
  EXPECT_GT(fit->near_parallax, 0.02);
  EXPECT_GT(fit->drift.dot(-(fit->now_from_then * Eigen::Vector3d::UnitX())), 0.999);
}

TEST(TurnFit, LeavesOutAThirdThatMovesByItself) {
  Scene scene(3);
  auto pairs = scene.pairs(120, moved({0.8, 0.0, 0.0}, 0.05));
  const auto away = moved({0.8, 0.0, 0.0}, 0.12);
  for (int i = 0; i < 60; ++i) pairs.push_back(scene.pair(8.0 * scene.direction(-1.0, 1.0), away));
  const auto fit = fit_turn(pairs, vision::so3_exp({0.0, 0.0, -0.06}));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->yaw_rad, 0.05, 0.0005);
  int wrong = 0;
  for (std::size_t i = 120; i < pairs.size(); ++i) wrong += fit->agrees[i] ? 1 : 0;
  EXPECT_LT(wrong, 15);
}

TEST(TurnFit, HasAnHonestVariance) {
  double whitened = 0.0, whitened_drift = 0.0;
  constexpr int kRuns = 200;
  Scene scene(4);
  const Eigen::Isometry3d now_from_then = moved({0.7, 0.05, 0.0}, 0.03, 0.01);
  const Eigen::Vector3d drift = now_from_then.translation();
  for (int i = 0; i < kRuns; ++i) {
    const auto fit = fit_turn(scene.pairs(80, now_from_then), Eigen::Matrix3d::Identity());
    ASSERT_TRUE(fit);
    whitened += std::pow(fit->yaw_rad - 0.03, 2) / fit->yaw_variance_rad2;
    const double off_rad = std::atan2(fit->drift.y(), fit->drift.x()) - std::atan2(drift.y(), drift.x());
    whitened_drift += std::pow(vision::wrap(off_rad, 2.0 * M_PI), 2) / fit->drift_azimuth_variance_rad2;
  }
  EXPECT_GT(whitened_drift / kRuns, 0.4);
  EXPECT_LT(whitened_drift / kRuns, 1.5);
  EXPECT_GT(whitened / kRuns, 0.5);
  EXPECT_LT(whitened / kRuns, 1.5);
}

TEST(TurnFit, IsHonestInFieldsWhereAllPointsAreNearTheHorizon) {
  double whitened = 0.0, whitened_drift = 0.0;
  constexpr int kRuns = 200;
  Scene scene(7);
  const Eigen::Isometry3d now_from_then = moved({8.0, -0.5, 0.0}, 0.2);
  const Eigen::Vector3d drift = now_from_then.translation();
  for (int run = 0; run < kRuns; ++run) {
    std::vector<BearingPair> pairs;
    for (int i = 0; i < 45; ++i) {  // woods: nearer on the left, none ahead; a fifth badly tracked
      const double azimuth = scene.between(0.6, 5.4), elevation = scene.between(-0.01, 0.1);
      const double range_m = azimuth < 3.0 ? scene.between(70.0, 110.0) : scene.between(120.0, 250.0);
      auto pair = scene.pair(range_m * Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), elevation), now_from_then);
      const double off_rad = i % 5 == 0 ? 0.006 : 0.001;
      pair.now = (pair.now + off_rad * Eigen::Vector3d{scene.normal(), scene.normal(), scene.normal()}).normalized();
      pairs.push_back(pair);
    }
    const auto fit = fit_turn(pairs, vision::so3_exp({0.0, 0.0, -0.19}));
    ASSERT_TRUE(fit);
    whitened += std::pow(fit->yaw_rad - 0.2, 2) / fit->yaw_variance_rad2;
    const double drift_off_rad = std::atan2(fit->drift.y(), fit->drift.x()) - std::atan2(drift.y(), drift.x());
    whitened_drift += std::pow(vision::wrap(drift_off_rad, 2.0 * M_PI), 2) / fit->drift_azimuth_variance_rad2;
  }
  EXPECT_LT(whitened / kRuns, 2.0);
  EXPECT_LT(whitened_drift / kRuns, 2.0);
}

TEST(TurnFit, NeedsSixPoints) {
  Scene scene(5);
  EXPECT_FALSE(fit_turn(scene.pairs(5, moved({1.0, 0.0, 0.0}, 0.0)), Eigen::Matrix3d::Identity()));
}

}  // namespace
}  // namespace panvo::panoramic_compass
