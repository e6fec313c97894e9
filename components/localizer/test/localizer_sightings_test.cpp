// SPDX-License-Identifier: Apache-2.0
// Sightings of two landmarks that confirm or contradict each other.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "drive.hpp"
#include "panvo/localizer/localizer.hpp"

namespace panvo::localizer {
namespace {

/// A drive past two landmarks.
struct TwoPlaces {
  explicit TwoPlaces(unsigned seed, const Parameters& parameters = of_known_scale())
      : drive(seed), localizer(parameters) {
    localizer.add(drive.now());
    for (int i = 0; i < 100; ++i) {
      localizer.add(drive.step());
      if (i % 60 != 10) continue;
      places.push_back(drive.truth);
      built &= localizer.add_built(static_cast<std::uint32_t>(places.size()), drive.now().stamp_ns);
    }
  }
  /// Advances one step and sees one of them, displaced.
  Correction see(std::uint32_t id, double off_m = 0.0, bool stands_alone = true, double sigma_m = 0.05) {
    localizer.add(drive.step());
    auto sighting = drive.sight(id, places[id - 1], sigma_m);
    sighting.landmark_from_base.translation().y() += off_m;
    sighting.stands_alone = stands_alone;
    return localizer.add(sighting);
  }

  Drive drive;
  Localizer localizer;
  std::vector<Eigen::Isometry3d> places;
  bool built = true;
};

TEST(LocalizerSightings, ForgetsWhatALandmarkSaidThatTheNextDidNotConfirm) {
  TwoPlaces two(3);
  ASSERT_TRUE(two.built);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(two.see(1, 40.0).kind, CorrectionKind::kRejected);
  EXPECT_EQ(two.see(2, 0.0, false).kind, CorrectionKind::kRejected) << "low-inlier match";
  const auto confirmed = two.see(2, 0.0, false);
  ASSERT_EQ(confirmed.kind, CorrectionKind::kApplied) << confirmed.reason;
  auto unreliable = two.drive.step();
  unreliable.is_reliable = false;
  two.localizer.add(unreliable);
  EXPECT_NE(two.localizer.latest().state, State::kLost) << two.localizer.latest().reason;
}

TEST(LocalizerSightings, APassBeforeTheVehicleWasLiftedIsAnother) {
  auto parameters = of_known_scale();
  parameters.second_look_m = 3.0;  // accuracy of the landmarks
  parameters.second_look_deg = 10.0;
  TwoPlaces two(4, parameters);
  ASSERT_EQ(two.see(2, 0.0, true, 0.01).kind, CorrectionKind::kApplied);
  auto lifted = two.drive.step(0.4, 25.0);
  lifted.is_reliable = false;
  two.localizer.add(lifted);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(two.see(1).kind, CorrectionKind::kRejected);
  EXPECT_EQ(two.see(2).kind, CorrectionKind::kRejected);
  const auto found = two.see(2);
  EXPECT_EQ(found.kind, CorrectionKind::kApplied) << found.reason << ": the better pass was before the lift";
  EXPECT_LT(error_m(two.localizer.latest(), two.drive), 3.0);
}

TEST(LocalizerSightings, ASecondPanoramaOfAnotherPassDoesNotSupportTheFirst) {
  const auto off_by = [](double chi_square) {
    TwoPlaces two(5);
    return std::sqrt(chi_square / two.see(1, 10.0).chi_square) * 10.0;
  };
  const double off_m = off_by(80.0);  // beyond the gate, but within the drift of odometry
  TwoPlaces close(5);
  EXPECT_EQ(close.see(1, off_m).kind, CorrectionKind::kRejected);
  EXPECT_EQ(close.see(1, off_m).kind, CorrectionKind::kApplied);
  TwoPlaces apart(5);
  EXPECT_EQ(apart.see(1, off_m).kind, CorrectionKind::kRejected);
  for (int i = 0; i < 60; ++i) apart.localizer.add(apart.drive.step());
  const auto later = apart.see(1, 1.3 * off_m);
  EXPECT_EQ(later.kind, CorrectionKind::kRejected) << later.chi_square;
}

/// Landmarks that are known to metres only.
Parameters of_rough_landmarks() {
  auto parameters = of_known_scale();
  parameters.second_look_m = 3.0;
  parameters.second_look_deg = 10.0;
  return parameters;
}

/// The vehicle is carried 25 m to the left; odometry only reports an unreliable frame.
void carry_away(TwoPlaces& two) {
  auto lifted = two.drive.step(0.4, 25.0);
  lifted.is_reliable = false;
  two.localizer.add(lifted);
}

TEST(LocalizerSightings, OfALatePanoramaCutTheOdometryBeforeIt) {
  TwoPlaces two(4, of_rough_landmarks());
  carry_away(two);
  // Each panorama is processed after the next frame, which is unreliable.
  const auto see_late = [&](std::uint32_t id) {
    two.localizer.add(two.drive.step());
    const auto sighting = two.drive.sight(id, two.places[id - 1]);
    auto unreliable = two.drive.step();
    unreliable.is_reliable = false;
    two.localizer.add(unreliable);
    return two.localizer.add(sighting);
  };
  for (int i = 0; i < 2; ++i) EXPECT_EQ(see_late(1).kind, CorrectionKind::kRejected);
  EXPECT_EQ(see_late(2).kind, CorrectionKind::kRejected);
  const auto found = see_late(2);
  ASSERT_EQ(found.kind, CorrectionKind::kApplied) << found.reason;
  EXPECT_LT(error_m(two.localizer.latest(), two.drive), 3.0);
}

TEST(LocalizerSightings, ThatComeAllAtOnceRelocaliseAsWell) {
  TwoPlaces two(4, of_rough_landmarks());
  carry_away(two);
  std::vector<LandmarkSighting> sightings;
  for (const std::uint32_t id : {1, 1, 2, 2}) {
    two.localizer.add(two.drive.step());
    sightings.push_back(two.drive.sight(id, two.places[id - 1]));
  }
  Correction last;
  for (const auto& sighting : sightings) last = two.localizer.add(sighting);
  ASSERT_EQ(last.kind, CorrectionKind::kApplied) << last.reason;
  EXPECT_EQ(two.localizer.latest().state, State::kRelocalised);
}

TEST(LocalizerSightings, ConfirmThePoseEvenIfAnotherOfTheirPassIsBetter) {
  TwoPlaces two(3);
  ASSERT_EQ(two.see(2, 0.0, true, 0.01).kind, CorrectionKind::kApplied);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(two.see(1, 40.0).kind, CorrectionKind::kRejected);
  ASSERT_FALSE(two.localizer.doubts().empty());
  EXPECT_EQ(two.see(2, 0.0, false).kind, CorrectionKind::kRejected) << "low-inlier match";
  const auto confirmed = two.see(2, 0.0, false);
  ASSERT_EQ(confirmed.kind, CorrectionKind::kBetterKnown) << confirmed.reason;
  EXPECT_TRUE(two.localizer.doubts().empty());
}

TEST(LocalizerSightings, ThatContradictABetterOneOfTheirPassLeaveTheDoubt) {
  TwoPlaces two(4, of_rough_landmarks());
  Eigen::Isometry3d off = Eigen::Isometry3d::Identity();
  off.translation().y() = 40.0;
  std::vector<LandmarkSighting> late;
  for (const std::uint32_t id : {1, 1, 2, 2}) {
    two.localizer.add(two.drive.step());
    late.push_back(two.drive.sight(id, off * two.places[id - 1]));
  }
  ASSERT_EQ(two.see(2, 0.0, true, 0.01).kind, CorrectionKind::kApplied);
  const auto before = two.localizer.latest();
  for (const auto& sighting : late) {
    const auto correction = two.localizer.add(sighting);
    EXPECT_EQ(correction.kind, CorrectionKind::kRejected) << correction.reason;
  }
  EXPECT_TRUE(two.localizer.latest().map_from_base.isApprox(before.map_from_base));
  EXPECT_FALSE(two.localizer.doubts().empty());
}

/// The path along a pass shows the mounting, wherever the landmark is.
TEST(LocalizerSightings, ThatAreRejectedStillShowATurnedCamera) {
  constexpr double kTurned_rad = 0.2;
  const Eigen::Isometry3d turn(vision::so3_exp(Eigen::Vector3d(0.0, 0.0, kTurned_rad)));
  Localizer localizer(of_known_scale());
  OdometryPose odometry;  // straight on
  localizer.add(odometry);
  ASSERT_TRUE(localizer.add_built(1, odometry.stamp_ns));
  for (int i = 0; i < 30; ++i) {
    odometry.stamp_ns += kPeriod_ns;
    odometry.odom_from_base.translation().x() += kStep_m;
    odometry.covariance += 1e-6 * vision::Matrix6d::Identity();
    localizer.add(odometry);
    LandmarkSighting sighting;
    sighting.stamp_ns = odometry.stamp_ns;
    sighting.landmark_id = 1;
    sighting.landmark_from_base = turn.inverse() * odometry.odom_from_base * turn;
    sighting.landmark_from_base.translation().y() += 40.0;  // the landmark is misplaced
    sighting.covariance = 1e-3 * vision::Matrix6d::Identity();
    sighting.stands_alone = false;
    ASSERT_EQ(localizer.add(sighting).kind, CorrectionKind::kRejected);
  }
  const auto found = localizer.mounting().misalignment();
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->yaw_rad, kTurned_rad, 0.02);
}

TEST(LocalizerSightings, EndTheDoubtAfterLostOdometryIfThereIsNoCompass) {
  for (const bool has_compass : {false, true}) {
    TwoPlaces two(6);
    if (has_compass) two.localizer.add(two.drive.azimuth(2.0 * M_PI / 200.0, 0.003));
    auto lost = two.drive.step();
    lost.is_reliable = false;
    two.localizer.add(lost);
    for (int i = 0; i < 5; ++i) two.localizer.add(two.drive.step());
    ASSERT_EQ(two.localizer.doubts().size(), 1U);
    ASSERT_EQ(two.see(2).kind, CorrectionKind::kApplied);
    EXPECT_EQ(two.localizer.doubts().empty(), !has_compass);
  }
}

}  // namespace
}  // namespace panvo::localizer
