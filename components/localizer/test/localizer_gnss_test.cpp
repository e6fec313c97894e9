// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "gnss_drive.hpp"
#include "panvo/localizer/localizer.hpp"

namespace panvo::localizer {
namespace {

constexpr int kSteps = 1000;
constexpr int kFixEvery = 5;  // 1 Hz
constexpr double kScale = 1.006;

Parameters parameters() {
  Parameters parameters;
  parameters.scale_sigma = 0.005;
  return parameters;
}

struct Outcome {
  double mean_error_m = 0.0;      // horizontal, in the map
  double mean_enu_error_m = 0.0;  // horizontal, on earth; of the second half
  int used = 0;
};

/// A localizer on a drive with a fix per second.
struct Journey {
  Journey(unsigned seed, double scale, double sigma_m) : drive(seed, scale, sigma_m) { localizer.add(drive.now()); }

  void go(int steps) {
    for (int i = 1; i <= steps; ++i) {
      localizer.add(drive.step());
      if (i % kFixEvery == 0) localizer.add(drive.fix());
    }
  }

  GnssDrive drive;
  Localizer localizer{parameters()};
};

using Change = std::function<bool(GnssFix&, int step)>;  // false: no fix

bool unchanged(GnssFix& /*fix*/, int /*step*/) { return true; }
bool none(GnssFix& /*fix*/, int /*step*/) { return false; }

/// 1 km at 5 m/s. `seed`: of all errors.
Outcome driven(unsigned seed, const Change& change, double sigma_m = 1.0) {
  GnssDrive drive(seed, kScale, sigma_m);
  Localizer localizer(parameters());
  localizer.add(drive.now());
  Outcome outcome;
  for (int i = 1; i <= kSteps; ++i) {
    localizer.add(drive.step());
    GnssFix fix = drive.fix();
    if (i % kFixEvery == 0 && change(fix, i)) {
      outcome.used += localizer.add(fix).use == FixUse::kUsed ? 1 : 0;
    }
    const Eigen::Vector3d error = localizer.latest().map_from_base.translation() - drive.truth.translation();
    outcome.mean_error_m += error.head<2>().norm() / kSteps;
    if (i <= kSteps / 2 || !localizer.has_enu()) continue;
    const Eigen::Vector3d on_earth =
        localizer.latest_in_enu().map_from_base.translation() - drive.true_enu_from_base().translation();
    outcome.mean_enu_error_m += 2.0 * on_earth.head<2>().norm() / kSteps;
  }
  return outcome;
}

constexpr unsigned kSeeds = 4;

double mean_over_seeds(const Change& change) {
  double sum = 0.0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) sum += driven(seed, change).mean_error_m / kSeeds;
  return sum;
}

TEST(LocalizerWithSatellites, LearnsTheScaleOfTheOdometry) {
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    Journey journey(seed, kScale, 0.3);
    journey.go(kSteps);
    const Localizer& localizer = journey.localizer;
    ASSERT_TRUE(localizer.has_enu());
    EXPECT_NEAR(localizer.scale().value, kScale, 4.0 * localizer.scale().sigma);
    EXPECT_LT(localizer.scale().sigma, 0.0015);  // it was assumed to be 0.005
  }
}

TEST(LocalizerWithSatellites, LearnsTheDelayOfTheFixes) {
  constexpr std::int64_t kDelay_ns = 150'000'000;
  GnssDrive drive(2, 1.0, 0.05);
  Localizer localizer(parameters());
  localizer.add(drive.now());
  std::optional<GnssFix> late;
  for (int i = 1; i <= kSteps; ++i) {
    localizer.add(drive.step());
    if (late) localizer.add(*late);
    late.reset();
    if (i % kFixEvery != 0) continue;
    late = drive.fix();
    late->stamp_ns += kDelay_ns;
  }
  EXPECT_NEAR(localizer.fix_delay().value, 0.15, 4.0 * localizer.fix_delay().sigma);
  EXPECT_LT(localizer.fix_delay().sigma, 0.05);
}

TEST(LocalizerWithSatellites, KeepThePositionWhenTheClockIsSetBack) {
  Journey journey(2, 1.0, 0.5);
  journey.go(203);
  auto& [drive, localizer] = journey;
  ASSERT_TRUE(localizer.has_enu());
  ASSERT_TRUE(localizer.add_built(7, drive.stamp_ns() - GnssDrive::kPeriod_ns));  // a node that is not solved yet
  localizer.add(drive.step());
  const auto before = localizer.latest_in_enu();
  localizer.set_clock_back(1'000'000'000);
  const auto after = localizer.latest_in_enu();
  EXPECT_TRUE(after.map_from_base.isApprox(before.map_from_base));
  // Only the way of this second at 5 m/s is added, along both axes.
  EXPECT_NEAR((after.covariance - before.covariance).norm(), std::sqrt(2.0) * 5.0 * 5.0, 0.5);
}

/// A journey in the map of an earlier one, whose place on earth is known; its landmarks are not seen.
struct SecondJourney : Journey {
  SecondJourney() : Journey(6, 1.0, 0.3) {
    Journey mapping(5, 1.0, 0.3);
    mapping.go(400);
    drive.truth.translation() << 60.0, -25.0, 0.0;
    drive.truth.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, -2.0));
    localizer.add_known(
        {1, -1, Eigen::Isometry3d(Eigen::Translation3d(5000.0, 0.0, 0.0)), 1e-4 * vision::Matrix6d::Identity()});
    localizer.set_known_enu(mapping.localizer.map_from_enu());
  }
};

TEST(LocalizerWithSatellites, ShowWhereTheVehicleIsInTheMapOfAnEarlierJourney) {
  SecondJourney second;
  second.go(20);
  EXPECT_EQ(second.localizer.latest().state, State::kUnlocated);
  second.go(100);
  const auto here = second.localizer.latest();
  EXPECT_EQ(here.state, State::kTracking);
  const vision::Vector6d error = vision::pose_error(here.map_from_base, second.drive.truth);
  EXPECT_LT(error.head<2>().norm(), 2.0);
  EXPECT_LT(std::abs(error(5)), 0.05);
  // 99.9 % of six degrees of freedom.
  EXPECT_LT(error.dot(here.covariance.ldlt().solve(error)), 22.5);
}

TEST(LocalizerWithSatellites, KeepThePlaceInTheMapWhenTheirFrameMoves) {
  SecondJourney second;
  second.go(400);
  ASSERT_EQ(second.localizer.latest().state, State::kTracking);
  const Eigen::Vector3d moved_m(20.0, 0.0, 0.0);
  bool has_begun_anew = false;
  for (int i = 1; i <= 400; ++i) {
    second.localizer.add(second.drive.step());
    GnssFix fix = second.drive.fix();
    fix.enu_m += moved_m;
    if (i % kFixEvery == 0) has_begun_anew |= second.localizer.add(fix).use == FixUse::kBegun;
  }
  EXPECT_TRUE(has_begun_anew);
  const auto here = second.localizer.latest();
  EXPECT_EQ(here.state, State::kTracking) << here.reason;
  const vision::Vector6d error = vision::pose_error(here.map_from_base, second.drive.truth);
  EXPECT_LT(error.dot(here.covariance.ldlt().solve(error)), 22.5);  // 99.9 % of six degrees of freedom
  EXPECT_LT(vision::horizontal_sigma(here.covariance), 10.0);
}

TEST(LocalizerWithSatellites, KnowsThePositionOnEarthAsWellAsTheFixes) {
  double with_m = 0.0, without_m = 0.0, on_earth_m = 0.0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const auto with = driven(seed, unchanged);
    EXPECT_GT(with.used, 60);  // of 100 that are 10 m apart
    with_m += with.mean_error_m / kSeeds;
    on_earth_m += with.mean_enu_error_m / kSeeds;
    without_m += driven(seed, none).mean_error_m / kSeeds;
  }
  // A fix has a mean error of 1.25 m, which persists for a quarter of the drive; odometry alone drifts by metres.
  EXPECT_LT(on_earth_m, 2.0);
  // In the map, the heading at the start limits what satellites can tell.
  EXPECT_LT(with_m, 0.9 * without_m);
  RecordProperty("on_earth_m", std::to_string(on_earth_m));
}

TEST(LocalizerWithSatellites, KnowsHowWellItKnowsThePositionOnEarth) {
  double nees = 0.0;
  constexpr int kDrives = 12;
  for (unsigned seed = 1; seed <= kDrives; ++seed) {
    Journey journey(seed, 1.002, 1.0);
    journey.go(kSteps);
    ASSERT_TRUE(journey.localizer.has_enu());
    const auto here = journey.localizer.latest_in_enu();
    const vision::Vector6d error = vision::pose_error(here.map_from_base, journey.drive.true_enu_from_base());
    nees += error.dot(here.covariance.ldlt().solve(error)) / 6.0 / kDrives;
  }
  // 72 degrees of freedom: a fair covariance gives 0.70 to 1.35 in 95 of 100 cases.
  EXPECT_GT(nees, 0.5);
  EXPECT_LT(nees, 1.35);
  RecordProperty("nees", std::to_string(nees));
}

TEST(LocalizerWithSatellites, IsAsBeforeWithoutThem) {
  GnssDrive drive(1, 1.0, 1.0);
  Localizer localizer(parameters());
  localizer.add(drive.now());
  for (int i = 1; i <= 20; ++i) localizer.add(drive.step());
  EXPECT_EQ(localizer.add(drive.fix()).use, FixUse::kOnTrial);
  EXPECT_EQ(localizer.add(drive.fix()).use, FixUse::kTooClose);
  EXPECT_FALSE(localizer.has_enu());
  EXPECT_EQ(localizer.scale().value, 1.0);
}

TEST(LocalizerWithSatellites, RejectAFixThatThePoseContradicts) {
  Journey journey(4, 1.0, 0.5);
  journey.go(203);
  auto& [drive, localizer] = journey;
  ASSERT_TRUE(localizer.has_enu());
  for (int i = 0; i < 10; ++i) localizer.add(drive.step());
  const auto before = localizer.latest().map_from_base;
  auto off = drive.fix();
  off.enu_m.x() += 60.0;
  const auto outcome = localizer.add(off);
  EXPECT_EQ(outcome.use, FixUse::kRejected);
  EXPECT_EQ(outcome.reason, "contradicts the pose");
  EXPECT_TRUE(localizer.latest().map_from_base.isApprox(before));
}

TEST(LocalizerWithSatellites, KeepsFixesThatAreEvenlySpaced) {
  LocalPoseGraph graph(0.01, 0.001, 0.0, {});
  GnssDrive drive(1, 1.0, 1.0);
  graph.start({drive.now(), 0.0});
  graph.set_enu(drive.true_enu_from_base(), std::nullopt);
  for (int i = 1; i <= 640; ++i) {
    const auto pose = drive.step();
    if (i % 2 == 0) graph.add_fix(drive.fix(), {pose, static_cast<double>(i)});
  }
  EXPECT_EQ(graph.size(), 65U);  // with the start
  EXPECT_TRUE(graph.solve());
}

TEST(LocalizerWithSatellites, KnowsWhatTheScaleAddsWhereThereAreNone) {
  Parameters of_scale;  // 0.002: the odometry is off by twice that
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    GnssDrive drive(seed, 1.004, 0.5);
    Localizer localizer(of_scale);
    localizer.add(drive.now());
    for (int i = 1; i <= 2200; ++i) {
      localizer.add(drive.step());
      if (i <= 200 && i % kFixEvery == 0) localizer.add(drive.fix());
    }
    ASSERT_TRUE(localizer.has_enu());
    const auto off = [](const PoseInMap& here, const Eigen::Isometry3d& truth) {
      const Eigen::Vector2d error = vision::pose_error(here.map_from_base, truth).head<2>();
      return error.dot(here.covariance.topLeftCorner<2, 2>().ldlt().solve(error));
    };
    // 99.9 % of two degrees of freedom.
    EXPECT_LT(off(localizer.latest_in_enu(), drive.true_enu_from_base()), 13.8);
    EXPECT_LT(off({localizer.latest().map_from_base, localizer.latest().covariance}, drive.truth), 13.8);
    EXPECT_EQ(localizer.add(drive.fix()).use, FixUse::kUsed);
  }
}

/// Metres between the fixes that are used.
class SpacedSatellites : public ::testing::TestWithParam<double> {};

TEST_P(SpacedSatellites, AreTriedAnewWhenTheirFrameMoves) {
  Parameters spaced = parameters();
  spaced.gnss.spacing_m = GetParam();
  GnssDrive drive(2, 1.0, 0.3);
  Localizer localizer(spaced);
  localizer.add(drive.now());
  int begun_m = 0;
  for (int i = 1; i <= 450; ++i) {
    localizer.add(drive.step());
    GnssFix fix = drive.fix();
    if (i > 100) fix.enu_m.x() += 40.0;
    if (localizer.add(fix).use == FixUse::kBegun) begun_m = i;
  }
  EXPECT_GE(begun_m, 100 + 300);
  EXPECT_LE(begun_m, 100 + 300 + 3 * 10);
}

INSTANTIATE_TEST_SUITE_P(Spacings, SpacedSatellites, ::testing::Values(1.0, 2.0, 4.0, 10.0));

TEST(LocalizerWithSatellites, ShowTheDirectionThoughTheirTrialIsLongerThanTheStoredOdometry) {
  Parameters slow = parameters();
  slow.history_s = 2.0;  // 10 m at 5 m/s, as 120 s are at 0.08 m/s
  GnssDrive drive(2, 1.0, 0.3);
  Localizer localizer(slow);
  localizer.add(drive.now());
  while (!localizer.has_enu() && drive.stamp_ns() < 100'000'000'000) {
    localizer.add(drive.step());
    localizer.add(drive.fix());
  }
  ASSERT_TRUE(localizer.has_enu());
  const auto here = localizer.latest_in_enu();
  EXPECT_LT(std::sqrt(here.covariance(5, 5)), 0.1);
  const vision::Vector6d error = vision::pose_error(here.map_from_base, drive.true_enu_from_base());
  EXPECT_LT(error.dot(here.covariance.ldlt().solve(error)), 22.5);  // 99.9 % of six degrees of freedom
}

TEST(LocalizerWithSatellites, CountAsOneOverAShortTime) {
  constexpr double kSigma_m = 2.0;
  LocalPoseGraph graph(0.01, 0.001, 0.0, {});
  GnssDrive drive(1, 1.0, kSigma_m);
  graph.start({drive.now(), 0.0});
  graph.set_enu(drive.true_enu_from_base().inverse(), std::nullopt);
  OdometryPose standing = drive.now();
  for (int i = 0; i <= 10; ++i) {  // a sixth of the time for which their errors persist
    standing.stamp_ns = i * 1'000'000'000LL;
    GnssFix fix = drive.fix();
    fix.stamp_ns = standing.stamp_ns;
    fix.antenna_in_base_m.setZero();
    graph.add_fix(fix, {standing, 0.0});
  }
  ASSERT_TRUE(graph.solve());
  // The steps of the odometry between them add a little.
  EXPECT_NEAR(graph.in_enu({standing, 0.0}).covariance(0, 0), kSigma_m * kSigma_m, 0.1);
}

TEST(LocalizerWithSatellites, CountASingleFixAsOne) {
  constexpr double kSigma_m = 2.0;
  LocalPoseGraph graph(0.01, 0.001, 0.0, {});
  GnssDrive drive(1, 1.0, kSigma_m);
  graph.start({drive.now(), 0.0});
  graph.set_enu(drive.true_enu_from_base().inverse(), std::nullopt);
  GnssFix fix = drive.fix();
  fix.antenna_in_base_m.setZero();
  graph.add_fix(fix, {drive.now(), 0.0});
  ASSERT_TRUE(graph.solve());
  const auto here = graph.in_enu({drive.now(), 0.0});
  EXPECT_LT((here.map_from_base.translation() - fix.enu_m).norm(), 0.01);
  EXPECT_NEAR(here.covariance(0, 0), kSigma_m * kSigma_m, 0.01);
}

const std::map<std::string, Change> kFaults = {
    {"Exchanged",
     [](GnssFix& fix, int) {
       std::swap(fix.enu_m.x(), fix.enu_m.y());
       return true;
     }},
    {"Frozen",
     [](GnssFix& fix, int step) {
       if (step > 400) fix.enu_m.setConstant(30.0);
       return true;
     }},
    {"Reflected",
     [](GnssFix& fix, int step) {
       if (step / 150 % 2 == 1) fix.enu_m += Eigen::Vector3d(25.0, -10.0, 15.0);
       return true;
     }},
    {"Drifting",
     [](GnssFix& fix, int step) {
       fix.enu_m.y() += 0.03 * step;
       return true;
     }},
    {"Late",
     [](GnssFix& fix, int) {
       fix.stamp_ns -= 1'000'000'000;
       return true;
     }},
    {"TenTimesWorseThanStated",
     [](GnssFix& fix, int step) {
       fix.enu_m += 10.0 * Eigen::Vector3d(std::sin(7.0 * step), std::cos(5.0 * step), 0.0);
       return true;
     }},
    {"InFeet",
     [](GnssFix& fix, int) {
       fix.enu_m /= 0.3048;
       return true;
     }},
};

class FaultySatellites : public ::testing::TestWithParam<std::string> {};

// No sensor makes it worse: at most 1.2 times the error without it.
TEST_P(FaultySatellites, DoNotMakeItWorse) {
  EXPECT_LE(mean_over_seeds(kFaults.at(GetParam())), 1.2 * mean_over_seeds(none));
}

INSTANTIATE_TEST_SUITE_P(Kinds, FaultySatellites,
                         ::testing::Values("Exchanged", "Frozen", "Reflected", "Drifting", "Late",
                                           "TenTimesWorseThanStated", "InFeet"),
                         [](const auto& fault) { return fault.param; });

}  // namespace
}  // namespace panvo::localizer
