// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "gnss_drive.hpp"
#include "panvo/localizer/localizer.hpp"

namespace panvo::localizer {
namespace {

constexpr double kScaleSigma = 0.002;
constexpr int kBend = 251;  // steps after which the road of the drives has its first direction again
constexpr int kFirst = 8 * kBend, kSpacing = 10, kLandmarks = 20;

Parameters of_scale() {
  Parameters parameters;
  parameters.scale_sigma = kScaleSigma;
  return parameters;
}

/// A first journey builds landmarks over 200 m, two kilometres from its start. A second one begins there, sees all of
/// them, and drives on. The odometry of each has a scale error of its own.
class BeyondTheMap {
 public:
  explicit BeyondTheMap(unsigned seed)
      : random_(seed), mapping_(2 * seed, drawn_scale(), 1.0), drive(2 * seed + 1, drawn_scale(), 1.0) {
    build();
    pass();
  }

  void go(int steps) {
    for (int i = 0; i < steps; ++i) localizer.add(drive.step());
  }

 private:
  double drawn_scale() { return 1.0 + kScaleSigma * normal_(random_); }

  void build() {
    Localizer mapped(of_scale());
    mapped.add(mapping_.now());
    for (int i = 1; i < kFirst + kSpacing * kLandmarks; ++i) {
      mapped.add(mapping_.step());
      if (i < kFirst || (i - kFirst) % kSpacing != 0) continue;
      places_.push_back(mapping_.truth);
      mapped.add_built(static_cast<std::uint32_t>(places_.size()), mapping_.stamp_ns());
    }
    for (const auto& landmark : mapped.landmarks()) localizer.add_known(landmark);
  }

  void pass() {
    drive.truth = places_.front();
    localizer.add(drive.now());
    for (std::size_t i = 0; i < places_.size(); ++i) {
      see(i);
      go(1);
      if (i == 0) see(i);  // two views are needed to join a map
      go(kSpacing - 1);
    }
  }

  void see(std::size_t place) {
    constexpr double kSigma_m = 0.05, kSigma_rad = 0.002;
    LandmarkSighting sighting;
    sighting.stamp_ns = drive.stamp_ns();
    sighting.landmark_id = static_cast<std::uint32_t>(place + 1);
    sighting.landmark_from_base = places_[place].inverse() * drive.truth;
    sighting.landmark_from_base.translation() += kSigma_m * noise();
    sighting.landmark_from_base.linear() = vision::so3_exp(kSigma_rad * noise()) * sighting.landmark_from_base.linear();
    sighting.covariance.topLeftCorner<3, 3>() = kSigma_m * kSigma_m * Eigen::Matrix3d::Identity();
    sighting.covariance.bottomRightCorner<3, 3>() = kSigma_rad * kSigma_rad * Eigen::Matrix3d::Identity();
    localizer.add(sighting);
  }

  Eigen::Vector3d noise() {
    const double x = normal_(random_), y = normal_(random_), z = normal_(random_);
    return {x, y, z};
  }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  GnssDrive mapping_;
  std::vector<Eigen::Isometry3d> places_;

 public:
  GnssDrive drive;
  Localizer localizer{of_scale()};
};

TEST(LocalizerInAStoredMap, KnowsHowWellItKnowsThePositionBeyondIt) {
  constexpr int kTrials = 40;
  constexpr int kBeyond = 6 * kBend;
  double in_map = 0.0, beyond = 0.0, landmark = 0.0;
  for (unsigned seed = 1; seed <= kTrials; ++seed) {
    BeyondTheMap journey(seed);
    const auto nees = [&] {
      const auto& here = journey.localizer.latest();
      return position_nees(here.map_from_base, journey.drive.truth, here.covariance) / kTrials;
    };
    ASSERT_EQ(journey.localizer.latest().state, State::kTracking) << journey.localizer.latest().reason;
    in_map += nees();
    journey.go(kBeyond);
    beyond += nees();
    ASSERT_TRUE(journey.localizer.add_built(100, journey.drive.stamp_ns()));
    const auto built = journey.localizer.landmarks().back();
    landmark += position_nees(built.map_from_base, journey.drive.truth, built.covariance) / kTrials;
  }
  RecordProperty("in_map", std::to_string(in_map));
  RecordProperty("beyond", std::to_string(beyond));
  RecordProperty("landmark", std::to_string(landmark));
  // 80 degrees of freedom: a fair covariance gives 0.71 to 1.33 in 95 of 100 cases.
  EXPECT_LT(in_map, 1.33);
  EXPECT_LT(beyond, 1.33);
  EXPECT_GT(beyond, 0.4);
  EXPECT_LT(landmark, 1.33);
}

}  // namespace
}  // namespace panvo::localizer
