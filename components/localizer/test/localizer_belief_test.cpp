// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/localizer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "drive.hpp"

namespace panvo::localizer {
namespace {

TEST(LocalizerBelief, ASightingAtSpeedTellsAsMuchAsTheClocksDo) {
  const auto variances_ahead = [](double clock_sigma_s) {
    auto parameters = of_known_scale();
    parameters.clock_sigma_s = clock_sigma_s;
    Round round(31, parameters);
    const Eigen::Vector3d ahead = round.drive.truth.linear().col(0);
    const auto ahead_of = [&](const LocalizedPose& pose) {
      return ahead.dot(pose.covariance.topLeftCorner<3, 3>() * ahead);
    };
    const double before = ahead_of(round.localizer.latest());
    EXPECT_EQ(round.localizer.add(round.drive.sight(1, round.landmark)).kind, CorrectionKind::kApplied);
    return std::pair(before, ahead_of(round.localizer.latest()));
  };
  // On a circle the yaw rate is constant, so the clock offset is not observable.
  constexpr double kClock_s = 0.01, kSpeed_mps = kStep_m * 1e9 / kPeriod_ns;
  const auto [before, after_known] = variances_ahead(0.0);
  const auto [same_before, after_unknown] = variances_ahead(kClock_s);
  EXPECT_LT(after_known, 0.1 * before);
  const double measured = after_known + 2.0 * kClock_s * kClock_s * kSpeed_mps * kSpeed_mps;
  EXPECT_NEAR(after_unknown, 1.0 / (1.0 / same_before + 1.0 / measured), 0.2 * after_unknown);
  EXPECT_NEAR(variances_ahead(0.05).second, after_unknown, 0.01 * after_unknown)
      << "in the same direction, it displaces the landmark alike";
}

TEST(LocalizerBelief, DoesNotBelieveAFarJumpBeforeASecondPanoramaAsksForIt) {
  Round round(4);
  auto wrong = round.drive.sight(1, round.landmark);
  wrong.landmark_from_base.translation() += Eigen::Vector3d(30.0, -10.0, 0.0);
  const auto before = round.localizer.latest();
  const auto correction = round.localizer.add(wrong);
  EXPECT_EQ(correction.kind, CorrectionKind::kRejected);
  EXPECT_NE(correction.reason.find("second view"), std::string::npos) << correction.reason;
  EXPECT_TRUE(round.localizer.latest().map_from_base.isApprox(before.map_from_base));
  // an inconsistent second sighting does not confirm it
  round.localizer.add(round.drive.step());
  auto other = round.drive.sight(1, round.landmark);
  other.landmark_from_base.translation() += Eigen::Vector3d(-20.0, 15.0, 0.0);
  EXPECT_EQ(round.localizer.add(other).kind, CorrectionKind::kRejected);
  // the correct one is applied at once
  EXPECT_EQ(round.localizer.add(round.drive.sight(1, round.landmark)).kind, CorrectionKind::kApplied);
}

TEST(LocalizerBelief, FindsItselfInTheMapOfAnEarlierDay) {
  Drive drive(6);
  Localizer localizer({});
  KnownLandmark known;
  known.id = 9;
  known.map_from_base.translation() = Eigen::Vector3d(500.0, 300.0, 2.0);
  known.map_from_base.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, 1.0));
  known.covariance = 1e-4 * vision::Matrix6d::Identity();
  localizer.add_known(known);
  localizer.add(drive.now());
  for (int i = 0; i < 10; ++i) {
    localizer.add(drive.step());
    EXPECT_EQ(localizer.latest().state, State::kUnlocated);
  }
  const Eigen::Isometry3d landmark = drive.truth;                                      // position of the landmark
  EXPECT_EQ(localizer.add(drive.sight(9, landmark)).kind, CorrectionKind::kRejected);  // one sighting is not enough
  localizer.add(drive.step());
  const auto correction = localizer.add(drive.sight(9, landmark));
  ASSERT_EQ(correction.kind, CorrectionKind::kApplied) << correction.reason;
  EXPECT_EQ(localizer.latest().state, State::kRelocalised);
  const Eigen::Isometry3d expected = known.map_from_base * landmark.inverse() * drive.truth;
  EXPECT_LT((localizer.latest().map_from_base.translation() - expected.translation()).norm(), 0.3);
}

/// Kinds of corrections of a vehicle that does not know where it is and sees two places, once each, the second one displaced.
std::pair<CorrectionKind, CorrectionKind> see_two_places(double off_m, bool stands_alone = true) {
  Drive drive(8);
  Localizer localizer({});
  for (const std::uint32_t id : {9, 10}) {
    KnownLandmark known;
    known.id = id;
    known.map_from_base.translation() = Eigen::Vector3d(500.0 + 12.0 * (id - 9), 300.0, 2.0);
    known.covariance = 1e-4 * vision::Matrix6d::Identity();
    localizer.add_known(known);
  }
  localizer.add(drive.now());
  const Eigen::Isometry3d first = drive.truth;
  const auto before = localizer.add(drive.sight(9, first)).kind;
  for (int i = 0; i < 8; ++i) localizer.add(drive.step());
  Eigen::Isometry3d second = first;
  second.translation() += Eigen::Vector3d(12.0 + off_m, 0.0, 0.0);
  auto sighting = drive.sight(10, second);
  sighting.stands_alone = stands_alone;
  return {before, localizer.add(sighting).kind};
}

TEST(LocalizerBelief, FindsItselfByTwoPlacesSeenOnceEachThatAgree) {
  const std::pair refused(CorrectionKind::kRejected, CorrectionKind::kRejected);
  EXPECT_EQ(see_two_places(0.0), std::pair(CorrectionKind::kRejected, CorrectionKind::kApplied));
  EXPECT_EQ(see_two_places(12.0), refused) << "pillars away";
  EXPECT_EQ(see_two_places(0.0, false), refused) << "few points";
}

/// A click on a flat map: half a metre, 15 degrees, height and tilt unknown.
PoseInMap clicked(const Eigen::Isometry3d& map_from_base) {
  PoseInMap said;
  said.map_from_base = map_from_base;
  said.map_from_base.translation().z() = 0.0;
  said.covariance.diagonal() << 0.25, 0.25, 0.0, 0.0, 0.0, 0.0685;
  return said;
}

TEST(LocalizerBelief, IsWhereSomebodySaysInTheMapOfAnEarlierDay) {
  Drive drive(7);
  Localizer localizer({});
  KnownLandmark known;
  known.id = 9;
  known.map_from_base.translation() = Eigen::Vector3d(500.0, 300.0, 2.0);
  known.covariance = 1e-4 * vision::Matrix6d::Identity();
  localizer.add_known(known);
  localizer.add(drive.now());
  for (int i = 0; i < 10; ++i) localizer.add(drive.step());
  ASSERT_EQ(localizer.latest().state, State::kUnlocated);
  const Eigen::Isometry3d map_from_truth = known.map_from_base * drive.truth.inverse();  // vehicle at the landmark
  ASSERT_TRUE(localizer.set_initial_pose(clicked(known.map_from_base), drive.now().stamp_ns));
  EXPECT_EQ(localizer.latest().state, State::kRelocalised);
  EXPECT_LT((localizer.latest().map_from_base.translation() - Eigen::Vector3d(500.0, 300.0, 0.0)).norm(), 1e-6);
  for (int i = 0; i < 5; ++i) localizer.add(drive.step());
  // one sighting makes it exact, as the landmark is near the given pose
  const auto correction = localizer.add(drive.sight(9, map_from_truth.inverse() * known.map_from_base));
  ASSERT_EQ(correction.kind, CorrectionKind::kApplied) << correction.reason;
  const Eigen::Isometry3d expected = map_from_truth * drive.truth;
  EXPECT_LT((localizer.latest().map_from_base.translation() - expected.translation()).norm(), 0.2);
}

TEST(LocalizerBelief, KeepsWhatItFoundWhereSomebodySaidWhenHeSaysAnotherPlace) {
  Drive drive(7);
  Localizer localizer({});
  KnownLandmark known;
  known.id = 9;
  known.covariance = 1e-4 * vision::Matrix6d::Identity();
  localizer.add_known(known);
  localizer.add(drive.now());
  Eigen::Isometry3d map_from_truth = Eigen::Isometry3d::Identity();
  map_from_truth.translation() = Eigen::Vector3d(500.0, 300.0, 0.0);
  ASSERT_TRUE(localizer.set_initial_pose(clicked(map_from_truth * drive.truth), drive.now().stamp_ns));
  for (int i = 0; i < 10; ++i) localizer.add(drive.step());
  const Eigen::Isometry3d place = map_from_truth * drive.truth;
  ASSERT_TRUE(localizer.add_built(1, drive.now().stamp_ns));
  localizer.add(drive.step());
  Eigen::Isometry3d elsewhere = map_from_truth * drive.truth;
  elsewhere.translation().x() -= 60.0;
  ASSERT_TRUE(localizer.set_initial_pose(clicked(elsewhere), drive.now().stamp_ns));
  EXPECT_LT((localizer.latest().map_from_base.translation() - elsewhere.translation()).norm(), 0.5);
  const auto landmarks = localizer.landmarks();
  ASSERT_EQ(landmarks.size(), 1U);
  EXPECT_LT((landmarks[0].map_from_base.translation() - place.translation()).norm(), 0.5);
}

TEST(LocalizerBelief, TakesAVehicleForMovedWhereSomebodySaysSo) {
  Round round(8);
  const auto before = round.localizer.landmarks();
  Eigen::Isometry3d elsewhere = round.drive.truth;
  elsewhere.translation() += Eigen::Vector3d(40.0, -25.0, 0.0);
  const auto smooth_before = round.localizer.latest().odom_from_base;
  ASSERT_TRUE(round.localizer.set_initial_pose(clicked(elsewhere), round.drive.now().stamp_ns));
  const auto& now = round.localizer.latest();
  EXPECT_LT((now.map_from_base.translation() - elsewhere.translation()).head<2>().norm(), 0.05);
  EXPECT_GT(vision::horizontal_sigma(now.covariance), 0.4);
  EXPECT_TRUE(now.odom_from_base.isApprox(smooth_before));  // odom never jumps
  const auto after = round.localizer.landmarks();
  ASSERT_EQ(after.size(), before.size());
  EXPECT_LT((after[0].map_from_base.translation() - before[0].map_from_base.translation()).norm(), 0.05);
}

TEST(LocalizerBelief, IsNotToldWhereItIsByNumbersThatAreNone) {
  Round round(9);
  PoseInMap said = clicked(round.drive.truth);
  said.map_from_base.translation().x() = std::nan("");
  EXPECT_FALSE(round.localizer.set_initial_pose(said, round.drive.now().stamp_ns));
  EXPECT_FALSE(
      round.localizer.set_initial_pose(clicked(round.drive.truth), round.drive.now().stamp_ns + 1'000'000'000'000));
}

TEST(LocalizerBelief, DoesNotFollowALandmarkThatIsInTheWrongPlace) {
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

TEST(LocalizerBelief, IsFoundAgainAfterItWasCarriedAway) {
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
  auto lifted = drive.step(0.4, 25.0);  // odometry only reports an unreliable frame
  lifted.is_reliable = false;
  localizer.add(lifted);
  localizer.add(drive.step());
  EXPECT_GT(error_m(localizer.latest(), drive), 20.0);
  EXPECT_EQ(localizer.add(drive.sight(1, places[0])).kind, CorrectionKind::kRejected);
  localizer.add(drive.step());
  EXPECT_EQ(localizer.add(drive.sight(1, places[0])).kind, CorrectionKind::kRejected)
      << "the landmark could be misplaced";
  localizer.add(drive.step());
  EXPECT_EQ(localizer.latest().state, State::kLost);
  for (int i = 0; i < 20; ++i) localizer.add(drive.step());
  EXPECT_EQ(localizer.add(drive.sight(2, places[1])).kind, CorrectionKind::kRejected);
  localizer.add(drive.step());
  const auto correction = localizer.add(drive.sight(2, places[1]));
  EXPECT_EQ(correction.kind, CorrectionKind::kApplied) << correction.reason;
  EXPECT_LT(error_m(localizer.latest(), drive), 1.5);
  EXPECT_EQ(localizer.latest().state, State::kRelocalised);
  for (int i = 0; i < 50; ++i) localizer.add(drive.step());
  EXPECT_EQ(localizer.latest().state, State::kTracking);
  // landmarks from before the lift stay in place
  const auto first = localizer.landmarks().front();
  EXPECT_LT((first.map_from_base.translation() - places[0].translation()).norm(), 1.0);
}

TEST(LocalizerBelief, DoesNotSayWhereItIsInAMapInWhichItWasNotFound) {
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
  ASSERT_EQ(localizer.landmarks().size(), 1U) << "the loaded one was not seen";
  EXPECT_GT(localizer.landmarks().front().covariance(0, 0), 1e6);
}

TEST(LocalizerBelief, BelievesFewPointsOnlyWhereTwoPanoramasAgreeAndTheVehicleIsExpected) {
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
  for (int i = 0; i < 5; ++i) {  // all agree on a wrong position
    auto far = other.drive.sight(1, other.landmark);
    far.stands_alone = false;
    far.landmark_from_base.translation() += Eigen::Vector3d(15.0, -10.0, 0.0);
    EXPECT_EQ(other.localizer.add(far).kind, CorrectionKind::kRejected) << i;
    other.localizer.add(other.drive.step());
  }
}

TEST(LocalizerBelief, IsNoSurerThanTheMapItIsIn) {
  Drive drive(18);
  Localizer localizer({});
  std::vector<Eigen::Isometry3d> places;
  for (std::uint32_t id = 1; id <= 4; ++id) {  // a map with a common offset within its covariance
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
  // landmarks of the map keep their covariance, and new ones are not more certain
  EXPECT_EQ(landmarks[0].covariance(0, 0), 1.0);
  EXPECT_GT(landmarks[4].covariance(0, 0), 1.0);
}

TEST(LocalizerBelief, SaysWhatIsWrongWithASighting) {
  Round round(7);
  auto unknown = round.drive.sight(77, round.landmark);
  EXPECT_EQ(round.localizer.add(unknown).reason, "landmark 77 is not known");
  auto early = round.drive.sight(1, round.landmark);
  early.stamp_ns -= 3'600'000'000'000;
  EXPECT_EQ(round.localizer.add(early).reason, "no odometry stored for that time");
  auto broken = round.drive.sight(1, round.landmark);
  broken.covariance(2, 2) = std::nan("");
  EXPECT_EQ(round.localizer.add(broken).reason, "has values that are not finite");
}

}  // namespace
}  // namespace panvo::localizer
