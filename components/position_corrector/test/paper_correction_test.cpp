// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/paper_correction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "synthetic_place.hpp"

namespace panvo::position_corrector {
namespace {

constexpr int kTurned = 180;  // columns: a sixth of the full turn to the left

class PaperCorrection : public testing::Test {
 protected:
  PaperCorrection() {
    for (const auto& keypoint : landmarks::detect_keypoints(place(1), {})) landmark.push_back(keypoint);
    match.state = MatchState::kMatched;
    match.stamp_ns = 5;
    match.landmark_id = 4;
    match.heading_rad = 2.0 * M_PI * kTurned / kColumns + 0.02;
    match.pass = LandmarkPass{{}, landmarks::detect_keypoints(turned(place(1), kTurned), {})};
  }

  void pass_with_slope(double slope) {
    for (int i = -10; i <= 10; ++i) match.pass->curve.push_back({50.0 + 0.3 * i, 0.2 + 0.3 * slope * std::abs(i)});
  }

  PositionCorrection correct() const { return paper_correction(match, landmark, {}, {}); }

  std::vector<landmarks::Keypoint> landmark;
  LandmarkMatch match;
};

// [Lu2015 5.2]
TEST_F(PaperCorrection, PutsTheVehicleWhereTheLandmarkIsWhenTheCurveIsSteep) {
  pass_with_slope(0.2);
  const auto correction = correct();
  EXPECT_EQ(correction.state, CorrectionState::kFull) << correction.reason;
  EXPECT_TRUE(correction.reason.empty());
  EXPECT_EQ(correction.stamp_ns, 5);
  EXPECT_EQ(correction.landmark_id, 4U);
  EXPECT_TRUE(correction.pose.landmark_from_base.translation().isZero());
  EXPECT_NEAR(heading_of(correction.pose.landmark_from_base.linear()), M_PI / 3.0, 0.005);
  EXPECT_NEAR(correction.pose.covariance(0, 0), 1.0, 1e-12);
}

// [Lu2015 5.2]
TEST_F(PaperCorrection, IsOfTheRotationOnlyWhenTheCurveIsFlat) {
  pass_with_slope(0.01);
  const auto correction = correct();
  EXPECT_EQ(correction.state, CorrectionState::kRotationOnly);
  EXPECT_NE(correction.reason.find("flat"), std::string::npos) << correction.reason;
  EXPECT_NEAR(heading_of(correction.pose.landmark_from_base.linear()), M_PI / 3.0, 0.005);
  EXPECT_NEAR(correction.pose.covariance(0, 0), 1e6, 1.0);
  EXPECT_LT(correction.pose.covariance(5, 5), 0.01);
}

// [Lu2015 5.2]
TEST_F(PaperCorrection, IsOfTheRotationOnlyWhenTheCurveIsTooShortToTell) {
  const auto correction = correct();
  EXPECT_EQ(correction.state, CorrectionState::kRotationOnly);
  EXPECT_EQ(correction.reason, "the distance curve is too short");
}

// [Lu2015 5.2]
TEST_F(PaperCorrection, IsRejectedWhereTooFewKeypointsAgree) {
  landmark = landmarks::detect_keypoints(place(9), {});
  pass_with_slope(0.2);
  const auto correction = correct();
  EXPECT_EQ(correction.state, CorrectionState::kRejected);
  EXPECT_NE(correction.reason.find("needed"), std::string::npos) << correction.reason;
}

TEST_F(PaperCorrection, IsForMatchedLandmarks) {
  match.state = MatchState::kLocked;
  EXPECT_THROW(correct(), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::position_corrector
