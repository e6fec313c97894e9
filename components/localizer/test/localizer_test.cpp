// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/localizer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace panvo::localizer {
namespace {

constexpr std::int64_t kPeriod_ns = 200'000'000;
constexpr double kStep_m = 1.0;
constexpr double kSigma_m = 0.02;  // of odometry, a step
constexpr double kSigma_rad = 0.003;

/// Round and round a circle of 200 m, with an odometry that drifts.
class Drive {
 public:
  explicit Drive(unsigned seed) : random_(seed) { poses.push_back(now()); }

  OdometryPose now() const { return {static_cast<std::int64_t>(steps_) * kPeriod_ns, odom_, covariance_, true}; }

  /// `missed_rad`: turned more than odometry says; `missed_m`: carried to the left by so much.
  OdometryPose step(double missed_rad = 0.0, double missed_m = 0.0) {
    ++steps_;
    Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
    move.translation().x() = kStep_m;
    move.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, 2.0 * M_PI / 200.0));
    const double yaw_before = yaw_rad;
    truth = truth * move;
    truth.linear() = truth.linear() * vision::so3_exp(Eigen::Vector3d(0.0, 0.0, missed_rad));
    truth.translation() += truth.linear() * Eigen::Vector3d(0.0, missed_m, 0.0);
    yaw_rad = yaw_before + 2.0 * M_PI / 200.0 + missed_rad;
    Eigen::Isometry3d measured = move;
    measured.translation() += kSigma_m * noise();
    measured.linear() = vision::so3_exp(kSigma_rad * noise()) * measured.linear();
    vision::Matrix6d gained = vision::Matrix6d::Identity();
    gained.topLeftCorner<3, 3>() *= kSigma_m * kSigma_m;
    gained.bottomRightCorner<3, 3>() *= kSigma_rad * kSigma_rad;
    covariance_ = vision::compose_covariance(odom_, covariance_, measured, gained);
    odom_ = odom_ * measured;
    poses.push_back(now());
    return now();
  }

  /// The turn since the last step, by the panoramas, with the given error.
  AzimuthMeasurement azimuth(double turn_rad, double sigma_rad) const {
    return {now().stamp_ns - kPeriod_ns, now().stamp_ns, turn_rad, sigma_rad * sigma_rad};
  }

  LandmarkSighting sight(std::uint32_t id, const Eigen::Isometry3d& landmark, double sigma_m = 0.05) {
    LandmarkSighting sighting;
    sighting.stamp_ns = now().stamp_ns;
    sighting.landmark_id = id;
    sighting.landmark_from_base = landmark.inverse() * truth;
    sighting.landmark_from_base.translation() += sigma_m * noise();
    sighting.landmark_from_base.linear() = vision::so3_exp(0.002 * noise()) * sighting.landmark_from_base.linear();
    sighting.covariance.topLeftCorner<3, 3>() = sigma_m * sigma_m * Eigen::Matrix3d::Identity();
    sighting.covariance.bottomRightCorner<3, 3>() = 0.002 * 0.002 * Eigen::Matrix3d::Identity();
    return sighting;
  }

  double yaw_rad = 0.0;
  Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();
  std::vector<OdometryPose> poses;

 private:
  Eigen::Vector3d noise() { return {normal_(random_), normal_(random_), normal_(random_)}; }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  int steps_ = 0;
  Eigen::Isometry3d odom_ = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance_ = vision::Matrix6d::Zero();
};

double nees_of(const LocalizedPose& pose, const Drive& drive) {
  const auto error = vision::pose_error(pose.map_from_base, drive.truth);
  return error.dot(pose.covariance.ldlt().solve(error)) / 6.0;
}

double error_m(const LocalizedPose& pose, const Drive& drive) {
  return (pose.map_from_base.translation() - drive.truth.translation()).norm();
}

/// The odometry of these drives has no error of scale.
Parameters of_known_scale() {
  Parameters parameters;
  parameters.scale_sigma = 0.0;
  return parameters;
}

/// Drives a round with a landmark at metre 20, and comes past it again.
struct Round {
  explicit Round(unsigned seed, const Parameters& parameters = of_known_scale()) : drive(seed), localizer(parameters) {
    localizer.add(drive.now());
    for (int i = 0; i < 220; ++i) {
      localizer.add(drive.step());
      if (i == 19) {
        landmark = drive.truth;
        built = localizer.add_built(1, drive.now().stamp_ns);
      }
    }
  }

  Drive drive;
  Localizer localizer;
  Eigen::Isometry3d landmark;
  bool built = false;
};

TEST(Localizer, IsOdometryWhereNothingIsSeen) {
  Drive drive(1);
  Localizer localizer({});
  EXPECT_EQ(localizer.latest().state, State::kStarting);
  localizer.add(drive.now());
  for (int i = 0; i < 50; ++i) {
    const auto odometry = drive.step();
    const auto pose = localizer.add(odometry);
    EXPECT_EQ(pose.state, State::kTracking);
    EXPECT_TRUE(pose.map_from_base.isApprox(odometry.odom_from_base, 1e-9));
    EXPECT_TRUE(pose.map_from_odom.isApprox(Eigen::Isometry3d::Identity(), 1e-9));
  }
}

TEST(Localizer, GetsThePositionBackWhereAPlaceIsSeenAgain) {
  double before = 0.0;
  double after = 0.0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Round round(seed);
    before += error_m(round.localizer.latest(), round.drive) / 10.0;
    const auto correction = round.localizer.add(round.drive.sight(1, round.landmark));
    ASSERT_EQ(correction.kind, CorrectionKind::kApplied) << correction.reason;
    after += error_m(round.localizer.latest(), round.drive) / 10.0;
  }
  EXPECT_GT(before, 1.5);           // that is, there was something to correct
  EXPECT_LT(after, 0.25 * before);  // what the landmark itself erred at its first visit, and the sighting
}

TEST(Localizer, HasACovarianceThatErrorsFollowBeforeAndAfter) {
  double before = 0.0;
  double after = 0.0;
  constexpr int kTrials = 60;
  for (unsigned seed = 1; seed <= kTrials; ++seed) {
    Round round(seed);
    before += nees_of(round.localizer.latest(), round.drive) / kTrials;
    round.localizer.add(round.drive.sight(1, round.landmark));
    after += nees_of(round.localizer.latest(), round.drive) / kTrials;
  }
  EXPECT_NEAR(before, 1.0, 0.4);
  EXPECT_NEAR(after, 1.0, 0.4);
}

TEST(Localizer, AppliesALateSightingAtItsOwnTime) {
  Round round(3);
  const auto sighting = round.drive.sight(1, round.landmark);
  for (int i = 0; i < 10; ++i) round.localizer.add(round.drive.step());
  EXPECT_EQ(round.localizer.add(sighting).kind, CorrectionKind::kApplied);
  EXPECT_LT(error_m(round.localizer.latest(), round.drive), 0.6);
}

TEST(Localizer, DoesNotBelieveAFarJumpBeforeASecondPanoramaAsksForIt) {
  Round round(4);
  auto wrong = round.drive.sight(1, round.landmark);
  wrong.landmark_from_base.translation() += Eigen::Vector3d(30.0, -10.0, 0.0);
  const auto before = round.localizer.latest();
  const auto correction = round.localizer.add(wrong);
  EXPECT_EQ(correction.kind, CorrectionKind::kRejected);
  EXPECT_NE(correction.reason.find("second panorama"), std::string::npos) << correction.reason;
  EXPECT_TRUE(round.localizer.latest().map_from_base.isApprox(before.map_from_base));
  // another that says something else does not support it
  round.localizer.add(round.drive.step());
  auto other = round.drive.sight(1, round.landmark);
  other.landmark_from_base.translation() += Eigen::Vector3d(-20.0, 15.0, 0.0);
  EXPECT_EQ(round.localizer.add(other).kind, CorrectionKind::kRejected);
  // the right one is believed at once
  EXPECT_EQ(round.localizer.add(round.drive.sight(1, round.landmark)).kind, CorrectionKind::kApplied);
}

TEST(Localizer, CountsOnlyTheBestPanoramaOfAPass) {
  Round round(5);
  EXPECT_EQ(round.localizer.add(round.drive.sight(1, round.landmark, 0.1)).kind, CorrectionKind::kApplied);
  round.localizer.add(round.drive.step());
  EXPECT_EQ(round.localizer.add(round.drive.sight(1, round.landmark, 0.3)).kind, CorrectionKind::kBetterKnown);
  round.localizer.add(round.drive.step());
  EXPECT_EQ(round.localizer.add(round.drive.sight(1, round.landmark, 0.03)).kind, CorrectionKind::kApplied);
}

TEST(Localizer, PullsTheLandmarksOfALoopStraight) {
  double straight = 0.0;
  double crooked = 0.0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Drive drive(seed);
    Localizer localizer({});
    localizer.add(drive.now());
    std::vector<Eigen::Isometry3d> landmarks;
    for (int i = 0; i < 205; ++i) {
      localizer.add(drive.step());
      if (i % 50 == 4 && i < 200) {
        landmarks.push_back(drive.truth);
        localizer.add_built(static_cast<std::uint32_t>(landmarks.size()), drive.now().stamp_ns);
      }
    }
    const auto worst = [&] {
      double sum = 0.0;
      const auto known = localizer.landmarks();
      for (std::size_t i = 0; i < known.size(); ++i) {
        sum += (known[i].map_from_base.translation() - landmarks[i].translation()).norm();
      }
      return sum / 40.0;
    };
    crooked += worst();
    localizer.add(drive.sight(1, landmarks[0]));
    straight += worst();
  }
  EXPECT_LT(straight, 0.75 * crooked);
}

TEST(Localizer, FindsItselfInTheMapOfAnEarlierDay) {
  Drive drive(6);
  Localizer localizer({});
  KnownLandmark known;
  known.id = 9;
  known.map_from_base.translation() = Eigen::Vector3d(500.0, 300.0, 2.0);
  known.map_from_base.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, 1.0));
  known.covariance = 1e-4 * vision::Matrix6d::Identity();
  localizer.add_known(known);
  localizer.add(drive.now());
  for (int i = 0; i < 10; ++i) EXPECT_EQ(localizer.add(drive.step()).state, State::kUnlocated);
  const Eigen::Isometry3d landmark = drive.truth;                                      // the place is here
  EXPECT_EQ(localizer.add(drive.sight(9, landmark)).kind, CorrectionKind::kRejected);  // one look is none
  localizer.add(drive.step());
  const auto correction = localizer.add(drive.sight(9, landmark));
  ASSERT_EQ(correction.kind, CorrectionKind::kApplied) << correction.reason;
  EXPECT_EQ(localizer.latest().state, State::kRelocalised);
  const Eigen::Isometry3d expected = known.map_from_base * landmark.inverse() * drive.truth;
  EXPECT_LT((localizer.latest().map_from_base.translation() - expected.translation()).norm(), 0.3);
}

TEST(Localizer, BelievesTheCompassWhereOdometryFollowsAMover) {
  Drive drive(11);
  Parameters one_clock;
  one_clock.clock_sigma_s = 0.0;
  Localizer localizer(one_clock);
  localizer.add(drive.now());
  double compass_rad = 0.0;
  for (int i = 0; i < 30; ++i) {
    const double yaw_before = drive.yaw_rad;
    // half a second of it, as when a bus fills the stereo view at a bend
    const auto odometry = drive.step(i >= 10 && i < 13 ? 0.05 : 0.0);
    localizer.add(odometry);
    compass_rad = drive.yaw_rad - yaw_before;
    const auto use = localizer.add(drive.azimuth(compass_rad, 0.002));
    EXPECT_EQ(use, i >= 10 && i < 13 ? AzimuthUse::kContradicted : AzimuthUse::kFused) << i;
  }
  const auto& pose = localizer.latest();
  const double error_rad = yaw_of(drive.truth.linear().transpose() * pose.map_from_base.linear());
  EXPECT_LT(std::abs(error_rad), 0.02) << "of 0.15 rad that odometry missed";
  EXPECT_LT(error_m(pose, drive), 0.8);
}

TEST(Localizer, HasACovarianceThatErrorsFollowAlsoWithACompass) {
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

TEST(Localizer, KeepsOdometryFreeOfJumpsWhileTheMapIsCorrected) {
  Round round(12);
  auto last = round.localizer.latest().odom_from_base;
  round.localizer.add(round.drive.sight(1, round.landmark));
  EXPECT_TRUE(round.localizer.latest().odom_from_base.isApprox(last));
  // a turn that odometry missed comes bit by bit
  double largest_rad = 0.0;
  for (int i = 0; i < 40; ++i) {
    round.localizer.add(round.drive.step(i == 0 ? 0.1 : 0.0));
    if (i == 0) round.localizer.add(round.drive.azimuth(2.0 * M_PI / 200.0 + 0.1, 0.001));
    const auto& pose = round.localizer.latest();
    largest_rad =
        std::max(largest_rad, std::abs(yaw_of((last.inverse() * pose.odom_from_base).linear()) - 2.0 * M_PI / 200.0));
    EXPECT_TRUE((pose.map_from_odom * pose.odom_from_base).isApprox(pose.map_from_base, 1e-9));
    last = pose.odom_from_base;
  }
  EXPECT_LT(largest_rad, 0.035);
  EXPECT_GT(largest_rad, 0.015);  // that is, there was something to make up for
}

TEST(Localizer, FindsByHowMuchThePanoramasClockIsOff) {
  Drive drive(13);
  Localizer localizer({});
  localizer.add(drive.now());
  constexpr double kOffset_s = 0.06;
  // odometry and truth at any time, of a drive that turns to and fro
  const auto yaw = [](double t) { return 0.3 * std::sin(1.3 * t); };
  const auto pose = [&](double t) {
    OdometryPose odometry;
    odometry.stamp_ns = static_cast<std::int64_t>(std::llround(t * 1e9));
    odometry.odom_from_base.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, yaw(t)));
    odometry.covariance = 1e-6 * (1.0 + t) * vision::Matrix6d::Identity();
    return odometry;
  };
  for (int i = 1; i < 500; ++i) {
    const double t = 100.0 + 0.04 * i;
    localizer.add(pose(t));
    if (i % 5 != 0 || i < 20) continue;
    const double taken = t - 0.2;  // stamped later than taken
    const auto stamp = [&](double at) { return static_cast<std::int64_t>(std::llround((at + kOffset_s) * 1e9)); };
    EXPECT_EQ(localizer.add(AzimuthMeasurement{stamp(taken - 0.2), stamp(taken), yaw(taken) - yaw(taken - 0.2), 1e-6}),
              AzimuthUse::kFused);
  }
  EXPECT_NEAR(localizer.panorama_clock().estimate_s(), kOffset_s, 0.003);
  EXPECT_LT(localizer.panorama_clock().variance_s2(), 0.006 * 0.006);
}

TEST(Localizer, DoesNotFollowALandmarkThatIsInTheWrongPlace) {
  Drive drive(14);
  Localizer localizer({});
  localizer.add(drive.now());
  for (int i = 0; i < 4; ++i) localizer.add(drive.step());
  const Eigen::Isometry3d place = drive.truth;
  ASSERT_TRUE(localizer.add_built(1, drive.now().stamp_ns));
  for (int i = 0; i < 20; ++i) {
    localizer.add(drive.step());
    auto moved = drive.sight(1, place);
    moved.landmark_from_base.translation() += Eigen::Vector3d(20.0, 0.0, 0.0);
    EXPECT_EQ(localizer.add(moved).kind, CorrectionKind::kRejected) << i;
  }
  EXPECT_LT(error_m(localizer.latest(), drive), 1.5);
}

TEST(Localizer, IsFoundAgainAfterItWasCarriedAway) {
  Drive drive(15);
  Localizer localizer({});
  localizer.add(drive.now());
  std::vector<Eigen::Isometry3d> places;
  for (int i = 0; i < 100; ++i) {
    localizer.add(drive.step());
    if (i % 30 != 10) continue;
    places.push_back(drive.truth);
    ASSERT_TRUE(localizer.add_built(static_cast<std::uint32_t>(places.size()), drive.now().stamp_ns));
  }
  auto lifted = drive.step(0.4, 25.0);  // and odometry knows only that it saw nothing for a moment
  lifted.is_reliable = false;
  localizer.add(lifted);
  localizer.add(drive.step());
  EXPECT_GT(error_m(localizer.latest(), drive), 20.0);
  EXPECT_EQ(localizer.add(drive.sight(1, places[0])).kind, CorrectionKind::kRejected);
  localizer.add(drive.step());
  EXPECT_EQ(localizer.add(drive.sight(1, places[0])).kind, CorrectionKind::kRejected)
      << "it could be in the wrong place";
  EXPECT_EQ(localizer.add(drive.step()).state, State::kLost);
  for (int i = 0; i < 20; ++i) localizer.add(drive.step());
  EXPECT_EQ(localizer.add(drive.sight(2, places[1])).kind, CorrectionKind::kRejected);
  localizer.add(drive.step());
  const auto correction = localizer.add(drive.sight(2, places[1]));
  EXPECT_EQ(correction.kind, CorrectionKind::kApplied) << correction.reason;
  EXPECT_LT(error_m(localizer.latest(), drive), 1.5);
  EXPECT_EQ(localizer.latest().state, State::kRelocalised);
  for (int i = 0; i < 50; ++i) localizer.add(drive.step());
  EXPECT_EQ(localizer.latest().state, State::kTracking);
  // landmarks of before the lift stay where they were
  const auto first = localizer.landmarks().front();
  EXPECT_LT((first.map_from_base.translation() - places[0].translation()).norm(), 1.0);
}

TEST(Localizer, SaysWhenItHasOnlyTheCompassAndWhenNothing) {
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
    last = localizer.add(unreliable).state;
  }
  EXPECT_EQ(last, State::kLost);
  EXPECT_NE(localizer.latest().reason.find("odometry unreliable for"), std::string::npos);
  EXPECT_EQ(localizer.add(drive.step()).state, State::kTracking);
}

TEST(Localizer, DoesNotSayWhereItIsInAMapInWhichItWasNotFound) {
  Drive drive(17);
  Localizer localizer({});
  KnownLandmark known;
  known.id = 3;
  known.covariance = 1e-4 * vision::Matrix6d::Identity();
  localizer.add_known(known);
  localizer.add(drive.now());
  for (int i = 0; i < 10; ++i) localizer.add(drive.step());
  EXPECT_GT(localizer.latest().covariance(0, 0), 1e6);
  ASSERT_TRUE(localizer.add_built(4, drive.now().stamp_ns));
  ASSERT_EQ(localizer.landmarks().size(), 1U) << "the other was not seen";
  EXPECT_GT(localizer.landmarks().front().covariance(0, 0), 1e6);
}

TEST(Localizer, BelievesFewPointsOnlyWhereTwoPanoramasAgreeAndTheVehicleIsExpected) {
  Round round(20);
  const auto weak = [&] {
    auto sighting = round.drive.sight(1, round.landmark);
    sighting.stands_alone = false;
    return sighting;
  };
  EXPECT_EQ(round.localizer.add(weak()).kind, CorrectionKind::kRejected);
  round.localizer.add(round.drive.step());
  EXPECT_EQ(round.localizer.add(weak()).kind, CorrectionKind::kApplied);
  Round other(21);
  for (int i = 0; i < 5; ++i) {  // all of them agree on a place that is elsewhere
    auto far = other.drive.sight(1, other.landmark);
    far.stands_alone = false;
    far.landmark_from_base.translation() += Eigen::Vector3d(15.0, -10.0, 0.0);
    EXPECT_EQ(other.localizer.add(far).kind, CorrectionKind::kRejected) << i;
    other.localizer.add(other.drive.step());
  }
}

TEST(Localizer, IsNoSurerThanTheMapItIsIn) {
  Drive drive(18);
  Localizer localizer({});
  std::vector<Eigen::Isometry3d> places;
  for (std::uint32_t id = 1; id <= 4; ++id) {  // a map that is off as a whole by as much as its covariance says
    KnownLandmark known;
    known.id = id;
    Drive ahead(18);
    for (std::uint32_t i = 0; i < 10 * id; ++i) ahead.step();
    places.push_back(ahead.truth);
    known.map_from_base = ahead.truth;
    known.map_from_base.translation().x() += 1.0;
    known.covariance = 1e-4 * vision::Matrix6d::Identity();
    known.covariance.topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity();
    localizer.add_known(known);
  }
  localizer.add(drive.now());
  for (int i = 1; i <= 42; ++i) {
    localizer.add(drive.step());
    if (i % 10 < 3 && i >= 10) {
      const auto id = static_cast<std::uint32_t>(i / 10);
      localizer.add(drive.sight(id, places[id - 1]));
    }
  }
  const auto& pose = localizer.latest();
  ASSERT_EQ(pose.state, State::kRelocalised);
  EXPECT_NEAR(error_m(pose, drive), 1.0, 0.3);
  EXPECT_GT(pose.covariance(0, 0), 1.0);
  ASSERT_TRUE(localizer.add_built(5, drive.now().stamp_ns));
  const auto landmarks = localizer.landmarks();
  ASSERT_EQ(landmarks.size(), 5U);
  // day after day, those of the map stay as sure as they are, and new ones are no surer
  EXPECT_EQ(landmarks[0].covariance(0, 0), 1.0);
  EXPECT_GT(landmarks[4].covariance(0, 0), 1.0);
}

TEST(Localizer, DoesNotKnowItsScale) {
  Drive drive(19);
  Parameters parameters;
  Parameters exact;
  exact.scale_sigma = 0.0;
  parameters.scale_sigma = 0.02;
  Localizer unsure(parameters);
  Localizer sure(exact);
  unsure.add(drive.now());
  sure.add(drive.now());
  for (int i = 0; i < 50; ++i) {
    const auto odometry = drive.step();
    unsure.add(odometry);
    sure.add(odometry);
  }
  const double way_m = unsure.latest().map_from_base.translation().norm();
  const double more = (unsure.latest().covariance - sure.latest().covariance).topLeftCorner<3, 3>().trace();
  EXPECT_NEAR(more, std::pow(0.02 * way_m, 2), 1e-6);
}

TEST(Localizer, SaysWhatIsWrongWithASighting) {
  Round round(7);
  auto unknown = round.drive.sight(77, round.landmark);
  EXPECT_EQ(round.localizer.add(unknown).reason, "landmark 77 is not known");
  auto early = round.drive.sight(1, round.landmark);
  early.stamp_ns -= 3'600'000'000'000;
  EXPECT_EQ(round.localizer.add(early).reason, "no odometry is remembered of that time");
  auto broken = round.drive.sight(1, round.landmark);
  broken.covariance(2, 2) = std::nan("");
  EXPECT_EQ(round.localizer.add(broken).reason, "numbers that are none");
}

TEST(Localizer, NeverTakesInANumberThatIsNone) {
  Drive drive(8);
  Localizer localizer({});
  localizer.add(drive.now());
  auto broken = drive.step();
  broken.odom_from_base.translation().x() = std::nan("");
  EXPECT_TRUE(localizer.add(broken).map_from_base.matrix().allFinite());
  EXPECT_TRUE(localizer.add(drive.step()).map_from_base.matrix().allFinite());
}

}  // namespace
}  // namespace panvo::localizer
