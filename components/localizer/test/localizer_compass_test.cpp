// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/localizer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "drive.hpp"
#include "winding_drive.hpp"

namespace panvo::localizer {
namespace {

TEST(LocalizerWithCompass, BelievesTheCompassWhereOdometryFollowsAMover) {
  Drive drive(11);
  Parameters one_clock;
  one_clock.clock_sigma_s = 0.0;
  Localizer localizer(one_clock);
  localizer.add(drive.now());
  double compass_rad = 0.0;
  for (int i = 0; i < 30; ++i) {
    const double yaw_before = drive.yaw_rad;
    // three frames of it, like a bus that fills the stereo view in a bend
    const auto odometry = drive.step(i >= 10 && i < 13 ? 0.05 : 0.0);
    localizer.add(odometry);
    compass_rad = drive.yaw_rad - yaw_before;
    const auto use = localizer.add(drive.azimuth(compass_rad, 0.002));
    EXPECT_EQ(use, i >= 10 && i < 13 ? AzimuthUse::kContradicted : AzimuthUse::kFused) << i;
  }
  const auto& pose = localizer.latest();
  const double error_rad = yaw_of(drive.truth.linear().transpose() * pose.map_from_base.linear());
  EXPECT_LT(std::abs(error_rad), 0.02) << "odometry missed 0.15 rad";
  EXPECT_LT(error_m(pose, drive), 0.8);
}

TEST(LocalizerWithCompass, HasACovarianceThatErrorsFollowAlsoWithACompass) {
  double nees = 0.0;
  constexpr int kTrials = 60;
  for (unsigned seed = 1; seed <= kTrials; ++seed) {
    Drive drive(seed);
    std::mt19937_64 random(seed + 1000);
    std::normal_distribution<double> normal;
    Localizer localizer(of_known_scale());
    localizer.add(drive.now());
    for (int i = 0; i < 100; ++i) {
      localizer.add(drive.step());
      localizer.add(drive.azimuth(2.0 * M_PI / 200.0 + 0.001 * normal(random), 0.001));
    }
    nees += nees_of(localizer.latest(), drive) / kTrials;
  }
  EXPECT_NEAR(nees, 1.0, 0.4);
}

/// A localizer after one step, in which odometry reports no turn.
struct OneStep {
  static constexpr double kSaid_rad2 = 1e-4;
  Localizer localizer;

  OneStep() : localizer(parameters()) {
    OdometryPose odometry;
    localizer.add(odometry);
    odometry.stamp_ns = kPeriod_ns;
    odometry.covariance = kSaid_rad2 * vision::Matrix6d::Identity();
    localizer.add(odometry);
  }

  AzimuthUse turn(double rad, double variance_rad2) { return localizer.add({0, kPeriod_ns, rad, variance_rad2}); }

  static Parameters parameters() {
    Parameters parameters = of_known_scale();
    parameters.clock_sigma_s = 0.0;
    parameters.compass_turn_error_ratio = 0.0;
    parameters.compass_correlation_ratio = 1.0;
    parameters.start_sigma_deg = 1e-6;
    return parameters;
  }
};

TEST(LocalizerWithCompass, WeighsOdometryAndCompassByTheirVariances) {
  constexpr double kTurn_rad = 0.004;
  OneStep step;
  EXPECT_EQ(step.turn(kTurn_rad, 0.25 * OneStep::kSaid_rad2), AzimuthUse::kFused);
  const auto& pose = step.localizer.latest();
  EXPECT_NEAR(yaw_of(pose.map_from_base.linear()) / kTurn_rad, 0.8, 1e-4);
  EXPECT_NEAR(pose.covariance(5, 5) / OneStep::kSaid_rad2, 0.2, 1e-4);
}

TEST(LocalizerWithCompass, ContradictsOdometryThatTurnsFarOutsideItsVariance) {
  constexpr double kSaid_rad = 0.01, kSure_rad2 = 1e-8;
  EXPECT_EQ(OneStep().turn(3.0 * kSaid_rad, kSure_rad2), AzimuthUse::kFused);
  EXPECT_EQ(OneStep().turn(4.5 * kSaid_rad, kSure_rad2), AzimuthUse::kContradicted);
}

TEST(LocalizerWithCompass, TakesTheLastOfTheTurnsAgainstOnePanorama) {
  constexpr double kTurn_rad = 2.0 * M_PI / 200.0;  // per step
  constexpr double kOff_rad = 0.001;                // common error of all turns against one panorama
  const auto drive_on = [](bool tells_all) {
    Drive drive(12);
    Parameters known;  // self-calibration would use each turn at other times
    known.clock_sigma_s = known.turn_scale_sigma = known.turn_lean_sigma_deg_m = 0.0;
    Localizer localizer(known);
    localizer.add(drive.now());
    for (int i = 0; i < 40; ++i) {
      localizer.add(drive.step());
      const int since = i % 4 + 1;
      if (!tells_all && since < 4) continue;
      const std::int64_t now_ns = drive.now().stamp_ns;
      localizer.add(AzimuthMeasurement{now_ns - since * kPeriod_ns, now_ns, since * kTurn_rad + kOff_rad, 1e-6});
    }
    return localizer.latest();
  };
  const auto all = drive_on(true), last = drive_on(false);
  EXPECT_LT(vision::pose_error(all.map_from_base, last.map_from_base).norm(), 1e-6);
  EXPECT_NEAR(all.covariance(5, 5), last.covariance(5, 5), 1e-9);
}

TEST(LocalizerWithCompass, LearnsByWhatShareOdometryTurnsTooMuch) {
  constexpr double kTurn_rad = 2.0 * M_PI / 200.0, kTooMuch = 0.003;
  Localizer localizer(Parameters{});
  OdometryPose odometry;
  const vision::Matrix6d gained = 1e-7 * vision::Matrix6d::Identity();
  localizer.add(odometry);
  const auto round = [&](bool has_compass) {  // excess of the localizer's yaw after one lap
    const Eigen::Matrix3d before = localizer.latest().map_from_base.linear();
    for (int i = 0; i < 200; ++i) {
      Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
      step.translation().x() = kStep_m;
      step.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, (1.0 + kTooMuch) * kTurn_rad));
      odometry.covariance = vision::compose_covariance(odometry.odom_from_base, odometry.covariance, step, gained);
      odometry.odom_from_base = odometry.odom_from_base * step;
      const std::int64_t before_ns = odometry.stamp_ns;
      odometry.stamp_ns += kPeriod_ns;
      localizer.add(odometry);
      if (has_compass) localizer.add(AzimuthMeasurement{before_ns, odometry.stamp_ns, kTurn_rad, 1e-8});
    }
    return yaw_of(before.transpose() * localizer.latest().map_from_base.linear());
  };
  for (int i = 0; i < 5; ++i) round(true);
  EXPECT_LT(std::abs(round(false)), 0.3 * kTooMuch * 2.0 * M_PI);
  // The published odom_from_base turns equally.
  const Eigen::Matrix3d before = localizer.latest().odom_from_base.linear();
  round(false);
  EXPECT_LT(std::abs(yaw_of(before.transpose() * localizer.latest().odom_from_base.linear())),
            0.3 * kTooMuch * 2.0 * M_PI);
}

/// A straight drive with odometry that leans to the left, and a compass that does not. Several panoramas are compared
/// with each reference.
struct Leaning {
  Leaning(const Parameters& parameters, double lean_rad_m, double stated_sigma_rad_m = 0.0)
      : localizer(parameters), lean_rad_m_(lean_rad_m) {
    odometry_.lean_sigma_rad_per_m = stated_sigma_rad_m;
    localizer.add(odometry_);
  }

  /// Returns the largest error of the heading on the way.
  double drive(int metres, bool has_compass) {
    double most_rad = 0.0;
    for (int i = 1; i <= metres; ++i) {
      Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
      step.translation().x() = kStep_m;
      step.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, lean_rad_m_));
      const vision::Matrix6d gained = 1e-7 * vision::Matrix6d::Identity();
      odometry_.covariance = vision::compose_covariance(odometry_.odom_from_base, odometry_.covariance, step, gained);
      odometry_.odom_from_base = odometry_.odom_from_base * step;
      odometry_.stamp_ns += kPeriod_ns;
      localizer.add(odometry_);
      if (has_compass) localizer.add(AzimuthMeasurement{reference_ns_, odometry_.stamp_ns, 0.0, kCompass_rad2});
      if (i % 4 == 0) reference_ns_ = odometry_.stamp_ns;
      most_rad = std::max(most_rad, std::abs(yaw_of(localizer.latest().map_from_base.linear())));
    }
    return most_rad;
  }

  Localizer localizer;

 private:
  static constexpr double kCompass_rad2 = 1e-7;

  double lean_rad_m_;
  OdometryPose odometry_;
  std::int64_t reference_ns_ = 0;
};

TEST(LocalizerWithCompass, TakesALastingLeanOfTheOdometryAwayOnce) {
  Parameters exact = of_known_scale();
  exact.clock_sigma_s = exact.turn_lean_sigma_deg_m = 0.0;
  constexpr double kLeanPerMetre_rad = 8e-4;  // as of a camera that looks sideways and whose calibration has aged
  EXPECT_LT(Leaning(exact, kLeanPerMetre_rad).drive(300, true), 0.1 * 300 * kLeanPerMetre_rad);
}

TEST(LocalizerWithCompass, LearnsWhatOdometryTurnsTooMuchPerMetre) {
  Parameters one_clock = of_known_scale();
  one_clock.clock_sigma_s = 0.0;
  constexpr double kLeanPerMetre_rad = 2e-4;  // one standard deviation
  Leaning leaning(one_clock, kLeanPerMetre_rad);
  leaning.drive(400, true);
  const double before_rad = yaw_of(leaning.localizer.latest().map_from_base.linear());
  const double published_rad = yaw_of(leaning.localizer.latest().odom_from_base.linear());
  leaning.drive(100, false);
  EXPECT_LT(std::abs(yaw_of(leaning.localizer.latest().map_from_base.linear()) - before_rad),
            0.4 * 100 * kLeanPerMetre_rad);
  EXPECT_LT(std::abs(yaw_of(leaning.localizer.latest().odom_from_base.linear()) - published_rad),
            0.4 * 100 * kLeanPerMetre_rad);
}

TEST(LocalizerWithCompass, BelievesThatOdometryLeansAsMuchAsItStates) {
  Parameters one_clock = of_known_scale();
  one_clock.clock_sigma_s = 0.0;
  constexpr double kLeanPerMetre_rad = 5e-4, kSmallRig_rad_m = 7e-4, kLargeRig_rad_m = 4e-5;
  const auto turned_without_compass = [&](double stated_sigma_rad_m) {
    Leaning leaning(one_clock, kLeanPerMetre_rad, stated_sigma_rad_m);
    leaning.drive(20, true);
    const double before_rad = yaw_of(leaning.localizer.latest().map_from_base.linear());
    leaning.drive(100, false);
    return yaw_of(leaning.localizer.latest().map_from_base.linear()) - before_rad;
  };
  EXPECT_LT(std::abs(turned_without_compass(kSmallRig_rad_m)), 0.15 * 100 * kLeanPerMetre_rad);
  EXPECT_GT(turned_without_compass(kLargeRig_rad_m), 0.5 * 100 * kLeanPerMetre_rad);
}

TEST(LocalizerWithCompass, CorrectsThePathSoFarByWhatItLearnsOfTheOdometrysTurns) {
  Parameters one_clock = of_known_scale();
  one_clock.clock_sigma_s = 0.0;
  constexpr double kLeanPerMetre_rad = 5e-4, kStated_rad_m = 7e-4;
  constexpr int kMetres = 40;
  Leaning leaning(one_clock, kLeanPerMetre_rad, kStated_rad_m);
  leaning.drive(kMetres, true);
  const auto& pose = leaning.localizer.latest().map_from_base;
  EXPECT_LT(std::abs(yaw_of(pose.linear())), 0.05 * kMetres * kLeanPerMetre_rad);
  EXPECT_LT(std::abs(pose.translation().y()), 0.05 * 0.5 * kMetres * kMetres * kLeanPerMetre_rad);
}

TEST(LocalizerWithCompass, IsAsSureOfAnOdometryThatLeansHoweverOftenItIsTold) {
  constexpr double kTurn_rad = 2.0 * M_PI / 200.0;  // per step
  const auto position_variance = [&](bool tells_all) {
    Drive drive(14);
    Parameters one_clock = of_known_scale();
    one_clock.clock_sigma_s = 0.0;
    Localizer localizer(one_clock);
    localizer.add(drive.now());
    for (int i = 0; i < 80; ++i) {
      const double missed_rad = i < 20 ? 0.0 : 0.8 * kSigma_rad;  // below the contradiction limit, always one direction
      localizer.add(drive.step(missed_rad));
      const int since = i % 4 + 1;
      if (!tells_all && since < 4) continue;
      const double turned_rad = since * (kTurn_rad + missed_rad);
      const std::int64_t now_ns = drive.now().stamp_ns;
      const auto use = localizer.add(AzimuthMeasurement{now_ns - since * kPeriod_ns, now_ns, turned_rad, 1e-6});
      EXPECT_TRUE(i < 79 || use == AzimuthUse::kContradicted) << "a bias over several seconds";
    }
    return localizer.latest().covariance.topLeftCorner<2, 2>().trace();
  };
  const double told_once = position_variance(false);
  EXPECT_NEAR(position_variance(true), told_once, 0.2 * told_once);
}

/// Offset of the panoramic camera's clock, s.
class LocalizerWithOtherClock : public testing::TestWithParam<double> {};

TEST_P(LocalizerWithOtherClock, FindsTheOffset) {
  constexpr double kBuilt_s = 101.2;
  const double offset_s = GetParam();
  Winding winding;
  const Localizer& localizer = winding.localizer;
  winding.drive(1, 51, offset_s);
  EXPECT_TRUE(winding.localizer.add_built(1, Winding::ns(kBuilt_s + offset_s)));
  winding.drive(51, 260, offset_s);
  for (const auto use : winding.uses) EXPECT_TRUE(use == AzimuthUse::kFused || use == AzimuthUse::kUnclear);
  winding.uses.clear();
  winding.drive(260, 500, offset_s);
  EXPECT_THAT(winding.uses, testing::Each(AzimuthUse::kFused));
  EXPECT_NEAR(localizer.panorama_clock().estimate_s(), offset_s, 0.003);
  EXPECT_LT(localizer.panorama_clock().variance_s2(), 0.006 * 0.006);
  const double error_rad = yaw_of(localizer.latest().map_from_base.linear()) - Winding::yaw(119.96);
  EXPECT_LT(std::abs(error_rad), 0.005);
  const Eigen::Isometry3d built = localizer.landmarks().at(0).map_from_base;
  EXPECT_NEAR(built.translation().x(), Winding::kSpeed * (kBuilt_s - 100.0), 0.02) << "before the offset was known";
}

INSTANTIATE_TEST_SUITE_P(Offsets, LocalizerWithOtherClock, testing::Values(0.0, 0.06, 0.15, 0.4, -0.3, 0.55),
                         [](const auto& of) { return "At" + std::to_string(of.index); });

TEST(LocalizerWithCompass, BelievesNoTurnOfAnotherTimeWhenTheClockIsSetOnTheWay) {
  constexpr double kBuilt_s = 117.0;
  Winding winding;
  winding.drive(1, 490, 0.0);
  EXPECT_TRUE(winding.localizer.add_built(1, Winding::ns(kBuilt_s)));
  winding.drive(490, 500, 0.0);
  for (const double ahead_s : {0.2, -0.2}) {
    Winding set = winding;
    set.uses.clear();
    set.drive(500, 900, ahead_s);
    EXPECT_THAT(set.uses, testing::Not(testing::Contains(AzimuthUse::kContradicted)));
    EXPECT_THAT(set.uses, testing::Contains(AzimuthUse::kUnclear));
    EXPECT_NEAR(set.localizer.panorama_clock().estimate_s(), ahead_s, 0.003);
    const double error_rad = yaw_of(set.localizer.latest().map_from_base.linear()) - Winding::yaw(135.96);
    EXPECT_LT(std::abs(error_rad), 0.01);
    const Eigen::Isometry3d built = set.localizer.landmarks().at(0).map_from_base;
    EXPECT_NEAR(built.translation().x(), Winding::kSpeed * (kBuilt_s - 100.0), 0.05) << "before the clock was set";
  }
}

TEST(LocalizerWithCompass, BelievesNoTurnBetweenPanoramasBeforeAndAfterTheClockIsSet) {
  Winding winding;
  winding.drive(1, 475, 0.0);
  // While turning at 0.4 rad/s: another 0.2 s are 0.08 rad.
  const double taken = 118.4, reference = taken - 0.6;
  ASSERT_GT(std::abs(Winding::yaw(taken + 0.1) - Winding::yaw(taken - 0.1)), 0.07);
  for (const double ahead_s : {0.2, -0.2}) {
    Winding set = winding;
    const double change_rad = Winding::yaw(taken) - Winding::yaw(reference);
    EXPECT_EQ(
        set.localizer.add(AzimuthMeasurement{Winding::ns(reference), Winding::ns(taken + ahead_s), change_rad, 1e-6}),
        AzimuthUse::kUnclear);
    // No other time explains 0.4 rad more.
    EXPECT_NE(set.localizer.add(AzimuthMeasurement{Winding::ns(reference), Winding::ns(taken), change_rad + 0.4, 1e-6}),
              AzimuthUse::kUnclear);
  }
}

TEST(LocalizerWithCompass, BelievesTheCompassWhereOdometryTurnsAsAtNoOtherTime) {
  Winding winding;
  winding.drive(1, 500, 0.0);
  winding.uses.clear();
  // a bus that fills the view turns away
  winding.drive(500, 600, 0.0, [](double t) { return 0.5 * std::clamp(t - 121.0, 0.0, 1.0); });
  EXPECT_THAT(winding.uses, testing::Contains(AzimuthUse::kContradicted).Times(testing::Ge(4))) << "in one second";
  const double error_rad = yaw_of(winding.localizer.latest().map_from_base.linear()) - Winding::yaw(123.96);
  EXPECT_LT(std::abs(error_rad), 0.12) << "odometry errs by 0.5 rad, of which one panorama misses 0.1";
}

TEST(LocalizerWithCompass, SaysWhenItHasOnlyTheCompassAndWhenNothing) {
  Drive drive(16);
  Localizer localizer({});
  localizer.add(drive.now());
  for (int i = 0; i < 10; ++i) localizer.add(drive.step());
  for (int i = 0; i < 10; ++i) {
    auto unreliable = drive.step();
    unreliable.is_reliable = false;
    localizer.add(unreliable);
    localizer.add(drive.azimuth(2.0 * M_PI / 200.0, 0.002));
    EXPECT_EQ(localizer.latest().state, State::kCompassOnly);
  }
  State last = State::kStarting;
  for (int i = 0; i < 10; ++i) {
    auto unreliable = drive.step();
    unreliable.is_reliable = false;
    localizer.add(unreliable);
    last = localizer.latest().state;
  }
  EXPECT_EQ(last, State::kLost);
  EXPECT_NE(localizer.latest().reason.find("odometry unreliable for"), std::string::npos);
  localizer.add(drive.step());
  EXPECT_EQ(localizer.latest().state, State::kTracking);
}

}  // namespace
}  // namespace panvo::localizer
