// SPDX-License-Identifier: Apache-2.0
// The localizer with contradicting odometry and panoramas.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <random>

#include "panvo/localizer/localizer.hpp"
#include "panvo/vision/angle.hpp"

namespace panvo::localizer {
namespace {

constexpr std::int64_t kFrame_ns = 40'000'000;
constexpr double kMetresPerSecond = 5.0;
constexpr int kFramesAPanorama = 5;

/// A vehicle driving straight at 5 m/s with 25 stereo pairs and 5 panoramas per second, and faults of its cameras.
class Straight {
 public:
  explicit Straight(const Parameters& of = parameters()) : localizer(of) { localizer.add(odometry_); }

  void drive(double seconds) {
    const int frames = static_cast<int>(std::lround(seconds * 25.0));
    for (int i = 0; i < frames; ++i) step();
  }

  void step() {
    ++frame_;
    true_x_m_ += speed_m_s * 0.04;
    Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
    move.translation() = vision::so3_exp({0.0, 0.0, rig_turned_rad}) * Eigen::Vector3d(speed_m_s * 0.04, 0.0, 0.0);
    if (mover_m_s) move.translation() = Eigen::Vector3d(0.0, *mover_m_s * 0.04, 0.0);  // it fills the whole view
    vision::Matrix6d gained = vision::Matrix6d::Identity();
    gained.topLeftCorner<3, 3>() *= 0.002 * 0.002;
    gained.bottomRightCorner<3, 3>() *= 1e-4 * 1e-4;
    odometry_.covariance = vision::compose_covariance(odometry_.odom_from_base, odometry_.covariance, move, gained);
    odometry_.odom_from_base = odometry_.odom_from_base * move;
    odometry_.stamp_ns = frame_ * kFrame_ns + static_cast<std::int64_t>(jitter_s * 1e9 * normal_(random_));
    odometry_.is_reliable = is_reliable;
    localizer.add(odometry_);
    if (frame_ % kFramesAPanorama != 0 || !has_panoramas) return;
    last_use = localizer.add(AzimuthMeasurement{
        odometry_.stamp_ns - kFramesAPanorama * kFrame_ns, odometry_.stamp_ns, compass_rad, turn_variance_rad2,
        camera_turned_rad, speed_m_s != 0.0 ? direction_variance_rad2 : 1.0, speed_m_s * 0.2 / farness_m});
    compass_rad = 0.0;
  }

  /// Rotates the panoramic camera on its mount between two panoramas.
  void turn_camera(double rad) {
    compass_rad = rad;         // as if the vehicle turned
    camera_turned_rad -= rad;  // and went on aside
  }

  void build(std::uint32_t landmark) {
    localizer.add_built(landmark, odometry_.stamp_ns);
    built_x_m_[landmark] = true_x_m_;
  }

  /// A place in a panorama, exact but for the heading. Returns whether it is believed.
  bool sees(std::uint32_t landmark, double heading_error_rad) {
    LandmarkSighting sighting{odometry_.stamp_ns, landmark};
    sighting.landmark_from_base.translation().x() = true_x_m_ - built_x_m_.at(landmark);
    sighting.landmark_from_base.linear() = vision::so3_exp({0.0, 0.0, heading_error_rad});
    sighting.covariance = 0.05 * 0.05 * vision::Matrix6d::Identity();
    sighting.covariance.bottomRightCorner<3, 3>() = 0.005 * 0.005 * Eigen::Matrix3d::Identity();
    return localizer.add(sighting).kind != CorrectionKind::kRejected;
  }

  /// Horizontal error in standard deviations.
  double error_in_sigmas() const {
    const auto& pose = localizer.latest();
    const Eigen::Vector2d error = pose.map_from_base.translation().head<2>() - Eigen::Vector2d(true_x_m_, 0.0);
    const Eigen::Matrix2d covariance = pose.covariance.topLeftCorner<2, 2>();
    return std::sqrt(error.dot(covariance.ldlt().solve(error)));
  }
  double sigma_m() const { return vision::horizontal_sigma(localizer.latest().covariance); }
  double error_m() const {
    return (localizer.latest().map_from_base.translation().head<2>() - Eigen::Vector2d(true_x_m_, 0.0)).norm();
  }
  bool is_usable() const {
    for (const auto& doubt : localizer.doubts()) {
      if (doubt.forbids_use) return false;
    }
    return true;
  }

  static Parameters parameters() {
    Parameters parameters;
    parameters.scale_sigma = parameters.turn_scale_sigma = parameters.turn_lean_sigma_deg_m = 0.0;
    parameters.clock_sigma_s = 0.0;
    return parameters;
  }

  Localizer localizer;
  double speed_m_s = kMetresPerSecond;
  std::optional<double> mover_m_s;
  double rig_turned_rad = 0.0, camera_turned_rad = 0.0, compass_rad = 0.0;
  bool has_panoramas = true, is_reliable = true;
  double turn_variance_rad2 = 1e-8, direction_variance_rad2 = 1e-5;  // of the panoramas
  double jitter_s = 0.0;                                             // standard deviation of the stamps
  double farness_m = 20.0;                                           // of what is beside the path
  AzimuthUse last_use = AzimuthUse::kNotUsed;

 private:
  OdometryPose odometry_;
  std::mt19937_64 random_{7};
  std::normal_distribution<double> normal_;
  std::int64_t frame_ = 0;
  double true_x_m_ = 0.0;
  std::map<std::uint32_t, double> built_x_m_;
};

TEST(LocalizerDispute, AgreesWithAVehicleThatDrivesAsBothSay) {
  Straight vehicle;
  vehicle.drive(10.0);
  EXPECT_EQ(vehicle.localizer.latest().state, State::kTracking);
  EXPECT_TRUE(vehicle.is_usable());
  EXPECT_LT(vehicle.sigma_m(), 0.2);
}

TEST(LocalizerDispute, TakesNoUnknownDirectionForAVehicleThatStands) {
  for (const double farness_m : {200.0, 5000.0}) {  // fields, and the sea or clouds
    Straight vehicle;
    vehicle.farness_m = farness_m;
    vehicle.direction_variance_rad2 = 1.0;
    vehicle.turn_variance_rad2 = 0.003 * 0.003;
    vehicle.drive(10.0);
    EXPECT_EQ(vehicle.localizer.latest().state, State::kTracking) << farness_m;
    EXPECT_LT(vehicle.sigma_m(), 0.11) << farness_m;
  }
}

TEST(LocalizerDispute, DoesNotBelieveADirectionThatThePanoramasHardlyKnow) {
  Straight vehicle;
  vehicle.direction_variance_rad2 = 0.2 * 0.2;
  vehicle.camera_turned_rad = 2.0;  // another motion explains the panoramas better
  vehicle.drive(10.0);
  EXPECT_EQ(vehicle.localizer.latest().state, State::kTracking);
  EXPECT_LT(vehicle.sigma_m(), 0.1);
}

TEST(LocalizerDispute, CoversWhatAMoverBeforeBothEyesTakesItAlong) {
  Straight vehicle;
  vehicle.drive(4.0);
  vehicle.mover_m_s = 3.0;
  vehicle.drive(0.2);
  EXPECT_FALSE(vehicle.is_usable()) << "the speed jump is detected before a panorama arrives";
  vehicle.drive(3.8);
  EXPECT_EQ(vehicle.localizer.latest().state, State::kCompassOnly);
  EXPECT_FALSE(vehicle.is_usable());
  vehicle.mover_m_s.reset();
  vehicle.drive(1.0);
  EXPECT_EQ(vehicle.localizer.latest().state, State::kTracking);
  EXPECT_GT(vehicle.error_m(), 20.0);
  EXPECT_LT(vehicle.error_in_sigmas(), 3.0);
}

TEST(LocalizerDispute, CanBeUsedHoweverStampsJitterUntilItFollowsAMover) {
  for (const bool has_panoramas : {true, false}) {
    for (const double jitter_s : {0.001, 0.002, 0.004}) {
      Straight vehicle;
      vehicle.speed_m_s = 10.0;
      vehicle.has_panoramas = has_panoramas;
      vehicle.jitter_s = jitter_s;
      int unusable = 0;
      for (int i = 0; i < 500; ++i) {
        vehicle.step();
        unusable += vehicle.is_usable() ? 0 : 1;
      }
      EXPECT_EQ(unusable, 0) << "of 500, " << jitter_s << " s, with panoramas: " << has_panoramas;
      vehicle.mover_m_s = 5.0;
      vehicle.drive(0.16);
      EXPECT_FALSE(vehicle.is_usable()) << jitter_s << " s, with panoramas: " << has_panoramas;
    }
  }
}

TEST(LocalizerDispute, KnowsOfAMoverThatPassesAVehicleThatStands) {
  Straight vehicle;
  vehicle.drive(4.0);
  vehicle.speed_m_s = 0.0;
  vehicle.drive(2.0);
  EXPECT_TRUE(vehicle.is_usable());
  vehicle.mover_m_s = 5.0;
  vehicle.drive(3.0);
  EXPECT_EQ(vehicle.localizer.latest().state, State::kCompassOnly);
  vehicle.mover_m_s.reset();
  vehicle.drive(2.0);
  EXPECT_EQ(vehicle.localizer.latest().state, State::kTracking);
  EXPECT_GT(vehicle.error_m(), 10.0);
  EXPECT_LT(vehicle.error_in_sigmas(), 3.0);
}

TEST(LocalizerDispute, KnowsOfAnOdometryThatStandsWhileTheVehicleDrives) {
  Straight vehicle;
  vehicle.drive(4.0);
  vehicle.mover_m_s = 0.0;  // a plastic sheet on both lenses
  vehicle.drive(3.0);
  EXPECT_EQ(vehicle.localizer.latest().state, State::kCompassOnly);
  EXPECT_GT(vehicle.error_m(), 10.0);
  EXPECT_LT(vehicle.error_in_sigmas(), 3.0);
}

TEST(LocalizerDispute, GoesOnWithTheOdometryWhereThePanoramicCameraWasTurned) {
  Straight vehicle;
  vehicle.drive(4.0);
  vehicle.turn_camera(30.0 * vision::kDegree);
  vehicle.drive(0.2);
  EXPECT_EQ(vehicle.last_use, AzimuthUse::kDoubted);
  EXPECT_FALSE(vehicle.is_usable());
  vehicle.drive(4.0);
  EXPECT_EQ(vehicle.last_use, AzimuthUse::kFused) << "with the new mounting";
  EXPECT_EQ(vehicle.localizer.latest().state, State::kTracking);
  EXPECT_LT(vehicle.error_m(), 0.1);
  const double yaw_sigma_rad = std::sqrt(vehicle.localizer.latest().covariance(5, 5));
  EXPECT_NEAR(yaw_sigma_rad, 30.0 / 9.0 * vision::kDegree, 0.5 * vision::kDegree)
      << "one chance in 81 that the vehicle turned";
}

TEST(LocalizerDispute, KnowsByTheDirectionOfMotionThatAPanoramicCameraWasTurned) {
  Straight vehicle;
  vehicle.drive(4.0);
  vehicle.has_panoramas = false;
  vehicle.drive(1.0);  // in that time a vehicle may turn as far, too
  vehicle.has_panoramas = true;
  vehicle.turn_camera(6.0 * vision::kDegree);
  vehicle.drive(0.2);
  EXPECT_EQ(vehicle.last_use, AzimuthUse::kDoubted);
  vehicle.drive(8.0);
  EXPECT_EQ(vehicle.last_use, AzimuthUse::kFused) << "with the new mounting";
  EXPECT_EQ(vehicle.localizer.latest().state, State::kTracking);
  EXPECT_LT(vehicle.error_m(), 0.1);
  EXPECT_LT(vehicle.sigma_m(), 1.0);
}

TEST(LocalizerDispute, KnowsByTheDirectionThatNoOtherClockExplainsATurnOfTheMount) {
  Parameters with_unknown_clock = Straight::parameters();
  with_unknown_clock.clock_sigma_s = Parameters().clock_sigma_s;
  Straight vehicle(with_unknown_clock);
  vehicle.drive(4.0);
  vehicle.turn_camera(14.0 * vision::kDegree);
  vehicle.drive(0.2);
  EXPECT_EQ(vehicle.last_use, AzimuthUse::kDoubted);
  vehicle.drive(2.0);
  EXPECT_EQ(vehicle.localizer.latest().state, State::kTracking);
  EXPECT_LT(vehicle.sigma_m(), 1.0);
}

TEST(LocalizerDispute, DoubtsATurnOfTheMountMoreWhereTheDirectionOfMotionStays) {
  const auto yaw_sigma_deg = [](bool is_mount) {
    Straight vehicle;
    vehicle.drive(4.0);
    vehicle.turn_camera(9.0 * vision::kDegree);
    if (!is_mount) vehicle.camera_turned_rad = 0.0;
    vehicle.drive(0.2);
    return std::sqrt(vehicle.localizer.latest().covariance(5, 5)) / vision::kDegree;
  };
  EXPECT_NEAR(yaw_sigma_deg(true), 1.0, 0.1) << "one chance in 81 that the vehicle turned";
  EXPECT_NEAR(yaw_sigma_deg(false), 3.0, 0.1) << "one in 9";
}

TEST(LocalizerDispute, TakesNoHeadingFromAPlaceByAPanoramicCameraThatWasTurnedSince) {
  for (const double degrees : {8.0, -40.0}) {
    Straight vehicle;
    vehicle.drive(4.0);
    vehicle.build(1);
    vehicle.turn_camera(degrees * vision::kDegree);
    vehicle.drive(12.0);
    vehicle.build(2);
    for (int i = 0; i < 3; ++i) {
      vehicle.drive(0.2);
      EXPECT_TRUE(vehicle.sees(1, vehicle.camera_turned_rad)) << degrees;
    }
    EXPECT_LT(vehicle.error_m(), 0.2) << degrees;
    vehicle.drive(4.0);
    EXPECT_LT(vehicle.error_m(), 0.3) << degrees << ": the heading is still that of the odometry";
    EXPECT_TRUE(vehicle.sees(2, 0.0)) << degrees;
    const double yaw_sigma_rad = std::sqrt(vehicle.localizer.latest().covariance(5, 5));
    EXPECT_LT(yaw_sigma_rad, 2.0 * vision::kDegree) << degrees << ": a place built after the turn tells it";
  }
}

TEST(LocalizerDispute, BelievesPanoramasThatTurnAsAVehicleMay) {
  Straight vehicle;
  vehicle.drive(4.0);
  vehicle.compass_rad = 2.0 * vision::kDegree;
  vehicle.drive(0.2);
  EXPECT_EQ(vehicle.last_use, AzimuthUse::kContradicted);
  const auto& pose = vehicle.localizer.latest();
  EXPECT_NEAR(yaw_of(pose.map_from_base.linear()), 2.0 * vision::kDegree, 0.1 * vision::kDegree);
  EXPECT_GT(std::sqrt(pose.covariance(5, 5)), 0.6 * vision::kDegree) << "odometry may still be right";
}

TEST(LocalizerDispute, IsUncertainAcrossTheWayAsTheTwoMountsDisagree) {
  Straight vehicle;
  vehicle.rig_turned_rad = 3.0 * vision::kDegree;
  for (int i = 0; i < 20; ++i) {
    vehicle.drive(1.0);
    EXPECT_LT(vehicle.error_in_sigmas(), 3.0) << "after " << i + 1 << " s";
  }
  EXPECT_EQ(vehicle.localizer.latest().state, State::kTracking);
  EXPECT_GT(vehicle.error_m(), 5.0);
}

TEST(LocalizerDispute, KnowsTheMountOfTheStereoCameraAsItWasMeasuredUnlessPanoramasKnowItBetter) {
  const auto sigma_m = [](double mounting_deg, double seconds) {
    auto parameters = Straight::parameters();
    parameters.stereo_mounting_sigma_deg = mounting_deg;
    Straight vehicle(parameters);
    vehicle.direction_variance_rad2 = 0.05 * 0.05;  // of one panorama; at 20 m, twenty know it to 0.7 deg
    vehicle.drive(seconds);
    return vehicle.sigma_m();
  };
  EXPECT_NEAR(sigma_m(60.0, 4.0), 0.23, 0.03);
  EXPECT_NEAR(sigma_m(0.3, 4.0), 0.10, 0.02);
  EXPECT_LT(sigma_m(0.001, 4.0), 0.05);
  EXPECT_NEAR(sigma_m(1.0, 40.0), sigma_m(60.0, 40.0), 0.03);
}

TEST(LocalizerDispute, LearnsHowAPanoramicCameraSitsThatWasNeverMeasured) {
  for (const double degrees : {-90.0, 35.0, 180.0}) {
    Straight vehicle;
    vehicle.camera_turned_rad = degrees * vision::kDegree;
    vehicle.drive(20.0);
    EXPECT_EQ(vehicle.localizer.latest().state, State::kTracking) << degrees;
    EXPECT_EQ(vehicle.last_use, AzimuthUse::kFused) << degrees;
    EXPECT_LT(vehicle.error_m(), 0.1) << degrees;
    const double off_deg = vehicle.localizer.direction_offset().estimate_rad() / vision::kDegree;
    EXPECT_NEAR(std::abs(off_deg), std::abs(degrees), 1.0);
  }
}

TEST(LocalizerDispute, LearnsAnewHowTheCamerasSitWhereItWasWrong) {
  Straight vehicle;
  vehicle.mover_m_s = 3.0;  // before the two have ever agreed
  vehicle.drive(2.0);
  vehicle.mover_m_s.reset();
  vehicle.drive(20.0);
  EXPECT_EQ(vehicle.localizer.latest().state, State::kTracking);
  EXPECT_NEAR(vehicle.localizer.direction_offset().estimate_rad(), 0.0, 1.0 * vision::kDegree);
}

TEST(LocalizerDispute, BelievesTheMountOfAStereoCameraThatIsAlone) {
  Straight vehicle;
  vehicle.has_panoramas = false;
  vehicle.drive(20.0);
  EXPECT_LT(vehicle.sigma_m(), 0.3);
}

/// Odometry restarts in one image, as after losing all its points.
void lose_sight(Straight& vehicle) {
  vehicle.is_reliable = false;
  vehicle.step();
  vehicle.is_reliable = true;
}

TEST(LocalizerDispute, NeedsPanoramasToVouchForABreakOfTheOdometry) {
  Straight vehicle;
  vehicle.drive(4.1);
  lose_sight(vehicle);
  EXPECT_FALSE(vehicle.is_usable()) << "until a panorama confirms";
  vehicle.drive(1.0);
  EXPECT_TRUE(vehicle.is_usable());
  EXPECT_LT(vehicle.sigma_m(), 0.2);
}

TEST(LocalizerDispute, TakesAVehicleForMovedWhereNoPanoramaVouchesForABreak) {
  Straight vehicle;
  vehicle.drive(4.1);
  vehicle.has_panoramas = false;  // panoramas find no points again either
  lose_sight(vehicle);
  vehicle.drive(0.5);
  EXPECT_FALSE(vehicle.is_usable());
  vehicle.has_panoramas = true;
  vehicle.drive(1.0);
  EXPECT_GT(vehicle.sigma_m(), 10.0);
}

TEST(LocalizerDispute, IsUnsureWhereItWasWhenTheClockIsSetBack) {
  Straight vehicle;
  vehicle.drive(4.0);
  vehicle.localizer.set_clock_back(2'000'000'000);
  const double way_m = 2.0 * kMetresPerSecond;
  EXPECT_GT(3.0 * vehicle.sigma_m(), way_m) << "if the new clock is wrong, it was that far back at the published stamp";
  EXPECT_LT(vehicle.sigma_m(), 3.0 * way_m);
}

}  // namespace
}  // namespace panvo::localizer
