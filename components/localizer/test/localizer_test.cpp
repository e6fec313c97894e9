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

  OdometryPose now() const { return {static_cast<std::int64_t>(steps_) * kPeriod_ns, odom_, covariance_}; }

  OdometryPose step() {
    ++steps_;
    Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
    move.translation().x() = kStep_m;
    move.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, 2.0 * M_PI / 200.0));
    truth = truth * move;
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

double error_m(const LocalizedPose& pose, const Drive& drive) {
  return (pose.map_from_base.translation() - drive.truth.translation()).norm();
}

/// Drives a round with a landmark at metre 20, and comes past it again.
struct Round {
  explicit Round(unsigned seed, const Parameters& parameters = {}) : drive(seed), localizer(parameters) {
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
  std::optional<KnownLandmark> built;
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
    const auto nees = [&] {
      const auto& pose = round.localizer.latest();
      const auto error = vision::pose_error(pose.map_from_base, round.drive.truth);
      return error.dot(pose.covariance.ldlt().solve(error)) / 6.0;
    };
    before += nees() / kTrials;
    round.localizer.add(round.drive.sight(1, round.landmark));
    after += nees() / kTrials;
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
