// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/localizer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "drive.hpp"

namespace panvo::localizer {
namespace {

TEST(Localizer, IsOdometryWhereNothingIsSeen) {
  Drive drive(1);
  Localizer localizer({});
  EXPECT_EQ(localizer.latest().state, State::kStarting);
  localizer.add(drive.now());
  for (int i = 0; i < 50; ++i) {
    const auto odometry = drive.step();
    localizer.add(odometry);
    const auto pose = localizer.latest();
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
  EXPECT_GT(before, 1.5);           // i.e. a correction was needed
  EXPECT_LT(after, 0.25 * before);  // error of the landmark at its first visit, and of the sighting
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

TEST(Localizer, KeepsOdometryFreeOfJumpsWhileTheMapIsCorrected) {
  Parameters one_clock = of_known_scale();
  one_clock.clock_sigma_s = 0.0;
  Round round(12, one_clock);
  auto last = round.localizer.latest().odom_from_base;
  round.localizer.add(round.drive.sight(1, round.landmark));
  EXPECT_TRUE(round.localizer.latest().odom_from_base.isApprox(last));
  // a turn that odometry missed is applied gradually
  double max_rad = 0.0;
  for (int i = 0; i < 40; ++i) {
    round.localizer.add(round.drive.step(i == 0 ? 0.1 : 0.0));
    if (i == 0) round.localizer.add(round.drive.azimuth(2.0 * M_PI / 200.0 + 0.1, 0.001));
    const auto& pose = round.localizer.latest();
    max_rad = std::max(max_rad, std::abs(yaw_of((last.inverse() * pose.odom_from_base).linear()) - 2.0 * M_PI / 200.0));
    EXPECT_TRUE((pose.map_from_odom * pose.odom_from_base).isApprox(pose.map_from_base, 1e-9));
    last = pose.odom_from_base;
  }
  EXPECT_LT(max_rad, 0.035);
  EXPECT_GT(max_rad, 0.015);  // i.e. a correction was needed
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

TEST(Localizer, NeverTakesInANumberThatIsNone) {
  Drive drive(8);
  Localizer localizer({});
  localizer.add(drive.now());
  auto broken = drive.step();
  broken.odom_from_base.translation().x() = std::nan("");
  EXPECT_FALSE(localizer.add(broken).is_taken);
  EXPECT_TRUE(localizer.latest().map_from_base.matrix().allFinite());
  EXPECT_TRUE(localizer.add(drive.step()).is_taken);
  EXPECT_TRUE(localizer.latest().map_from_base.matrix().allFinite());
}

}  // namespace
}  // namespace panvo::localizer
