// SPDX-License-Identifier: Apache-2.0
// The localizer with odometry whose speed jumps while its direction stays right.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>

#include "panvo/localizer/localizer.hpp"

namespace panvo::localizer {
namespace {

/// A vehicle that drives straight ahead, with 25 stereo pairs per second.
class Ahead {
 public:
  Ahead() : localizer(parameters()) { localizer.add(odometry_); }

  void drive(double seconds) {
    const int frames = static_cast<int>(std::lround(seconds * 25.0));
    for (int i = 0; i < frames; ++i) step();
  }

  void build(std::uint32_t id = 1) {
    built_at_m_[id] = true_x_m_;
    EXPECT_TRUE(localizer.add_built(id, odometry_.stamp_ns));
  }
  /// What a panorama of now shows of a place, from however far.
  LandmarkSighting sight(std::uint32_t id, double error_m = 0.0, double sigma_m = 0.01) const {
    LandmarkSighting sighting;
    sighting.stamp_ns = odometry_.stamp_ns;
    sighting.landmark_id = id;
    sighting.landmark_from_base.translation().x() = true_x_m_ - built_at_m_.at(id) + error_m;
    sighting.covariance = sigma_m * sigma_m * vision::Matrix6d::Identity();
    return sighting;
  }
  void see(const LandmarkSighting& sighting) {
    const auto correction = localizer.add(sighting);
    EXPECT_EQ(correction.kind, CorrectionKind::kApplied) << correction.reason;
  }
  void see(std::uint32_t id = 1) { see(sight(id)); }
  /// Somebody says where the vehicle is.
  void say() {
    PoseInMap pose{Eigen::Isometry3d(Eigen::Translation3d(true_x_m_, 0.0, 0.0)),
                   0.01 * 0.01 * vision::Matrix6d::Identity()};
    EXPECT_TRUE(localizer.set_initial_pose(pose, odometry_.stamp_ns));
  }

  double error_m() const { return std::abs(localizer.latest().map_from_base.translation().x() - true_x_m_); }
  double sigma_m() const { return std::sqrt(localizer.latest().covariance(0, 0)); }
  bool is_usable() const {
    for (const auto& doubt : localizer.doubts()) {
      if (doubt.forbids_use) return false;
    }
    return localizer.latest().state == State::kTracking;
  }
  double doubted_m() const {
    double sum_m = 0.0;
    for (const auto& doubt : localizer.doubts()) sum_m += doubt.off_m;
    return sum_m;
  }

  Localizer localizer;
  double speed_m_s = 5.0;
  double scale = 1.0;       // of the odometry
  double farness_m = 12.0;  // of what is beside the path
  bool has_panoramas = true;
  int pairs_per_panorama = 5;
  bool is_reliable = true;

 private:
  static Parameters parameters() {
    Parameters parameters;
    parameters.scale_sigma = parameters.turn_scale_sigma = parameters.turn_lean_sigma_deg_m = 0.0;
    parameters.clock_sigma_s = 0.0;
    return parameters;
  }

  void step() {
    constexpr std::int64_t kPair_ns = 40'000'000;
    ++frame_;
    true_x_m_ += speed_m_s * 0.04;
    Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
    move.translation().x() = scale * speed_m_s * 0.04;
    vision::Matrix6d gained = 1e-4 * 1e-4 * vision::Matrix6d::Identity();
    gained.topLeftCorner<3, 3>() = 0.002 * 0.002 * Eigen::Matrix3d::Identity();
    odometry_.covariance = vision::compose_covariance(odometry_.odom_from_base, odometry_.covariance, move, gained);
    odometry_.odom_from_base = odometry_.odom_from_base * move;
    odometry_.stamp_ns = frame_ * kPair_ns;
    odometry_.is_reliable = is_reliable;
    localizer.add(odometry_);
    if (frame_ % pairs_per_panorama != 0 || !has_panoramas) return;
    const double way_m = speed_m_s * 0.04 * pairs_per_panorama;
    localizer.add(AzimuthMeasurement{odometry_.stamp_ns - pairs_per_panorama * kPair_ns, odometry_.stamp_ns, 0.0, 1e-8,
                                     0.0, speed_m_s != 0.0 ? 1e-5 : 1.0, way_m / farness_m});
  }

  OdometryPose odometry_;
  std::int64_t frame_ = 0;
  double true_x_m_ = 0.0;
  std::map<std::uint32_t, double> built_at_m_;
};

TEST(LocalizerSpeed, CoversAnOdometryWhoseSpeedJumpsAlthoughItsDirectionStays) {
  for (const double scale : {0.45, 0.5, 2.0, 3.0, 0.0}) {
    for (const double after_s : {0.0, 0.08, 0.16}) {  // the last panorama
      Ahead vehicle;
      vehicle.drive(5.0 + after_s);
      vehicle.scale = scale;
      vehicle.drive(0.2);
      EXPECT_FALSE(vehicle.is_usable()) << scale << ", " << after_s << " s";
      for (int i = 0; i < 6; ++i) {
        vehicle.drive(0.4);
        EXPECT_FALSE(vehicle.is_usable()) << scale << ", " << after_s << " s, " << i;
        EXPECT_LT(vehicle.error_m(), 3.0 * vehicle.sigma_m() + vehicle.doubted_m())
            << scale << ", " << after_s << " s, " << i;
      }
      EXPECT_EQ(vehicle.localizer.latest().state, State::kCompassOnly) << scale << ", " << after_s << " s";
      EXPECT_NEAR(vehicle.sigma_m(), vehicle.error_m(), 0.4 * vehicle.error_m()) << scale << ", " << after_s << " s";
    }
  }
}

TEST(LocalizerSpeed, IsDoubtedAsLongAsPanoramasContradictIt) {
  for (const double scale : {0.5, 2.0, 0.0}) {
    Ahead vehicle;
    vehicle.drive(5.0);
    vehicle.scale = scale;
    vehicle.drive(0.2);
    for (int i = 0; i < 20; ++i) {
      vehicle.drive(0.4);
      EXPECT_FALSE(vehicle.is_usable()) << scale << ", " << i;
      EXPECT_LT(vehicle.error_m(), 3.0 * vehicle.sigma_m() + vehicle.doubted_m()) << scale << ", " << i;
    }
    EXPECT_EQ(vehicle.localizer.latest().state, State::kCompassOnly) << scale;
    EXPECT_NEAR(vehicle.sigma_m(), vehicle.error_m(), 0.4 * vehicle.error_m()) << scale;
    vehicle.scale = 1.0;
    vehicle.drive(1.0);
    EXPECT_TRUE(vehicle.is_usable()) << scale;
    const double sigma_m = vehicle.sigma_m();
    vehicle.drive(4.0);
    EXPECT_LT(vehicle.sigma_m(), sigma_m + 0.1) << scale;
  }
}

TEST(LocalizerSpeed, IsDoubtedAsLongAsPanoramasOfASlowCameraContradictIt) {
  for (const int pairs : {25, 37, 50}) {  // per panorama: 1 Hz to 0.5 Hz
    for (const double scale : {0.5, 2.0, 0.0}) {
      Ahead vehicle;
      vehicle.pairs_per_panorama = pairs;
      vehicle.drive(20.2);
      EXPECT_TRUE(vehicle.is_usable()) << pairs << ", " << scale;
      vehicle.scale = scale;
      vehicle.drive(0.2);
      for (int i = 0; i < 20; ++i) {
        vehicle.drive(0.4);
        EXPECT_FALSE(vehicle.is_usable()) << pairs << ", " << scale << ", " << i;
        EXPECT_LT(vehicle.error_m(), 3.0 * vehicle.sigma_m() + vehicle.doubted_m())
            << pairs << ", " << scale << ", " << i;
      }
      vehicle.scale = 1.0;
      vehicle.drive(0.04 * 5.0 * pairs);
      EXPECT_TRUE(vehicle.is_usable()) << pairs << ", " << scale;
    }
  }
}

TEST(LocalizerSpeed, IsNotLostBetweenThePanoramasOfASlowCamera) {
  Ahead vehicle;
  vehicle.pairs_per_panorama = 37;
  vehicle.drive(10.0);
  vehicle.is_reliable = false;
  for (int i = 0; i < 50; ++i) {
    vehicle.drive(0.08);
    EXPECT_EQ(vehicle.localizer.latest().state, State::kCompassOnly) << i;
  }
}

TEST(LocalizerSpeed, IsDoubtedBeyondAStopAndAtOtherSpeeds) {
  Ahead vehicle;
  vehicle.drive(5.0);
  vehicle.scale = 2.0;
  vehicle.drive(6.0);
  for (const double speed_m_s : {4.0, 3.0, 2.0, 1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}) {
    vehicle.speed_m_s = speed_m_s;
    vehicle.drive(1.0);
    EXPECT_FALSE(vehicle.is_usable()) << speed_m_s << " m/s";
    EXPECT_LT(vehicle.error_m(), 3.0 * vehicle.sigma_m() + vehicle.doubted_m()) << speed_m_s << " m/s";
  }
}

TEST(LocalizerSpeed, IsDoubtedBeyondAPlaceThatProvesItWrong) {
  Ahead vehicle;
  vehicle.drive(2.0);
  vehicle.build();
  vehicle.drive(3.0);
  vehicle.scale = 2.0;
  vehicle.drive(8.0);
  vehicle.see();
  EXPECT_LT(vehicle.error_m(), 0.2);
  for (int i = 0; i < 5; ++i) {
    vehicle.drive(1.0);
    EXPECT_FALSE(vehicle.is_usable()) << i;
    EXPECT_LT(vehicle.error_m(), 3.0 * vehicle.sigma_m() + vehicle.doubted_m()) << i;
  }
}

/// A place has proven the speed wrong. Where the pose has been corrected since, another place is where it is expected.
class LocalizerSpeedProvenWrong : public testing::Test {
 protected:
  LocalizerSpeedProvenWrong() {
    vehicle_.drive(2.0);
    for (const std::uint32_t id : {1U, 2U, 3U}) vehicle_.build(id);
    vehicle_.drive(3.0);
    vehicle_.scale = 2.0;
    vehicle_.drive(8.0);
  }
  void expect_doubt() {
    for (int i = 0; i < 5; ++i) {
      EXPECT_FALSE(vehicle_.is_usable()) << i;
      EXPECT_LT(vehicle_.error_m(), 3.0 * vehicle_.sigma_m() + vehicle_.doubted_m()) << i;
      vehicle_.drive(1.0);
    }
  }

  Ahead vehicle_;
};

TEST_F(LocalizerSpeedProvenWrong, IsDoubtedBeyondPlacesBetweenTwoPanoramas) {
  vehicle_.see(vehicle_.sight(1, 0.0, 0.3));
  vehicle_.drive(0.16);
  vehicle_.see(vehicle_.sight(2, 0.0, 0.1));
  vehicle_.drive(0.04);
  vehicle_.see(vehicle_.sight(3, 0.0, 0.1));
  expect_doubt();
}

TEST_F(LocalizerSpeedProvenWrong, IsDoubtedBeyondPlacesThatWereRecognisedLaterAndLater) {
  vehicle_.see(1);
  vehicle_.drive(0.2);
  const auto late = vehicle_.sight(2);
  vehicle_.drive(0.8);
  vehicle_.see(late);
  expect_doubt();
}

TEST_F(LocalizerSpeedProvenWrong, IsDoubtedBeyondASightingWhoseErrorIsOdometrys) {
  vehicle_.see(vehicle_.sight(1, 0.0, 0.3));
  vehicle_.drive(0.2);
  vehicle_.see(vehicle_.sight(2, 0.9, 0.3));  // three standard deviations
  expect_doubt();
}

TEST_F(LocalizerSpeedProvenWrong, IsDoubtedBeyondAnExternalPose) {
  vehicle_.say();
  vehicle_.drive(0.4);
  vehicle_.see(1);
  expect_doubt();
}

TEST_F(LocalizerSpeedProvenWrong, IsDoubtedBeyondAPlaceThatWasBuiltSince) {
  vehicle_.build(4);
  vehicle_.drive(2.0);
  vehicle_.see(4);
  expect_doubt();
}

TEST(LocalizerSpeed, IsDoubtedNoLongerWhereAPlaceProvesItRight) {
  Ahead vehicle;
  vehicle.drive(2.0);
  vehicle.build();
  vehicle.drive(3.0);
  vehicle.speed_m_s *= 2.0;  // whoever does that where everything is suddenly twice as far away
  vehicle.farness_m *= 2.0;
  vehicle.drive(8.0);
  EXPECT_FALSE(vehicle.is_usable());
  vehicle.see();
  vehicle.drive(1.0);
  EXPECT_TRUE(vehicle.is_usable());
  EXPECT_LT(vehicle.sigma_m(), 0.2);
}

TEST(LocalizerSpeed, CanBeUsedAgainWhereTheOdometryIsRightAgain) {
  for (const double scale : {0.45, 2.0}) {
    Ahead vehicle;
    vehicle.drive(5.0);
    vehicle.scale = scale;
    vehicle.drive(2.0);
    vehicle.scale = 1.0;
    vehicle.drive(1.0);
    EXPECT_TRUE(vehicle.is_usable()) << scale;
    EXPECT_LT(vehicle.error_m(), 3.0 * vehicle.sigma_m()) << scale;
    const double sigma_m = vehicle.sigma_m();
    vehicle.drive(4.0);
    EXPECT_LT(vehicle.sigma_m(), sigma_m + 0.1) << scale;
  }
}

TEST(LocalizerSpeed, ConfirmsByTheParallaxASpeedThatIsRight) {
  for (const double speed_m_s : {2.0, 12.0}) {
    for (const double scenery : {0.75, 1.0, 1.3}) {
      Ahead vehicle;
      vehicle.drive(5.0);
      vehicle.speed_m_s = speed_m_s;  // a crash, or whoever else is right
      vehicle.farness_m *= scenery;
      vehicle.drive(0.12);
      EXPECT_FALSE(vehicle.is_usable()) << speed_m_s << " m/s, " << scenery;
      vehicle.drive(0.68);
      EXPECT_TRUE(vehicle.is_usable()) << speed_m_s << " m/s, " << scenery;
      vehicle.drive(2.0);
      EXPECT_TRUE(vehicle.is_usable()) << speed_m_s << " m/s, " << scenery;
      EXPECT_LT(vehicle.sigma_m(), 0.5) << speed_m_s << " m/s, " << scenery;
    }
  }
}

TEST(LocalizerSpeed, DoubtsForASecondWhatPanoramasCannotTell) {
  const auto after_the_jump = [](double farness_m, double scale) {
    Ahead vehicle;
    vehicle.speed_m_s = 10.0;
    vehicle.farness_m = farness_m;
    vehicle.drive(5.0);
    vehicle.scale = scale;
    vehicle.drive(0.8);
    EXPECT_FALSE(vehicle.is_usable()) << farness_m << " m, " << scale;
    EXPECT_GT(vehicle.doubted_m(), vehicle.error_m()) << farness_m << " m, " << scale;
    vehicle.drive(1.2);
    EXPECT_TRUE(vehicle.is_usable()) << farness_m << " m, " << scale;
    const double sigma_m = vehicle.sigma_m();
    vehicle.drive(4.0);
    EXPECT_LT(vehicle.sigma_m(), sigma_m + 0.1) << farness_m << " m, " << scale;
    return sigma_m;
  };
  EXPECT_NEAR(after_the_jump(20'000.0, 2.0), 10.0 / 3.0, 1.3) << "nothing near beside the path";
  EXPECT_NEAR(after_the_jump(20.0, 1.4), 4.0 / 3.0, 0.6) << "scenery changes as much";
}

TEST(LocalizerSpeed, ForgetsAJumpThatNoPanoramaSaw) {
  Ahead vehicle;
  vehicle.has_panoramas = false;
  vehicle.drive(2.0);
  vehicle.scale = 2.0;
  vehicle.drive(20.0);
  EXPECT_TRUE(vehicle.is_usable());
  vehicle.scale = 1.0;
  vehicle.drive(0.2);
  EXPECT_FALSE(vehicle.is_usable());
  EXPECT_LT(vehicle.doubted_m(), 5.0) << "by the last jump";
}

TEST(LocalizerSpeed, IsNoDoubtWhereTheSceneryChangesButNotTheSpeed) {
  Ahead vehicle;
  vehicle.drive(5.0);
  for (const double farness_m : {30.0, 4.0, 200.0, 12.0}) {  // a yard, an arch, a bridge
    vehicle.farness_m = farness_m;
    for (int i = 0; i < 10; ++i) {
      vehicle.drive(0.2);
      EXPECT_TRUE(vehicle.is_usable()) << farness_m << " m";
    }
  }
  EXPECT_LT(vehicle.sigma_m(), 0.2);
}

}  // namespace
}  // namespace panvo::localizer
