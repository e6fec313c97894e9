// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/five_point_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "panvo/vision/pose.hpp"

namespace panvo::position_corrector {
namespace {

using landmarks::Keypoint;

constexpr double kHeading_rad = 2.2;

/// Points seen from a landmark and from another position; the keypoints have no metric points, as the method needs
/// none.
class Views {
 public:
  explicit Views(const Eigen::Vector3d& away_m, double noise_rad = 0.0, double tilt_rad = 0.03, unsigned seed = 7)
      : random_(seed) {
    landmark_from_panorama.translation() = away_m;
    landmark_from_panorama.linear() = vision::so3_exp(Eigen::Vector3d(0.0, -kHeading_rad, 0.0)) *
                                      vision::so3_exp(Eigen::Vector3d(tilt_rad, 0.0, 0.0));
    for (int i = 0; i < 150; ++i) add(noise_rad);
  }

  /// Moves every `nth` current keypoint to a wrong bearing near the horizon.
  void disturb(std::size_t nth) {
    for (std::size_t i = 0; i < panorama.size(); i += nth) {
      const Eigen::Vector3f turned =
          Eigen::AngleAxisf(0.25F, Eigen::Vector3f(0.3F, 1.0F, 0.6F).normalized()) * panorama[i].bearing;
      panorama[i].bearing = turned.normalized();
    }
  }

  double rotation_error_rad(const FivePointMotion& motion) const {
    return vision::so3_log(motion.rotation * landmark_from_panorama.linear().transpose()).norm();
  }

  std::vector<Keypoint> landmark, panorama;
  Eigen::Isometry3d landmark_from_panorama = Eigen::Isometry3d::Identity();

 private:
  double any() { return 2.0 * static_cast<double>(random_() >> 11U) * 0x1p-53 - 1.0; }
  void add(double noise_rad) {
    const double azimuth = M_PI * any();
    const double range_m = 18.0 + 10.0 * any();
    const Eigen::Vector3d point(range_m * std::sin(azimuth), -3.0 + 4.0 * any(), range_m * std::cos(azimuth));
    Keypoint then;
    then.bearing = point.normalized().cast<float>();
    for (auto& byte : then.descriptor) byte = static_cast<std::uint8_t>(random_() % 90);
    landmark.push_back(then);
    Keypoint now = then;
    const Eigen::Vector3d noise{any(), any(), any()};
    const Eigen::Vector3d seen = (landmark_from_panorama.inverse() * point).normalized();
    now.bearing = (seen + noise_rad * noise).normalized().cast<float>();
    panorama.push_back(now);
  }

  std::mt19937_64 random_;
};

// [Lu2015 5.2]
TEST(FivePointMotion, FindsTheRotationAndTheDirectionOfTheWay) {
  const Views views({1.5, 0.1, 2.0});
  const auto result = estimate_five_point_motion(views.panorama, views.landmark, kHeading_rad + 0.05, {});
  ASSERT_TRUE(result.motion) << result.reason;
  EXPECT_LT(views.rotation_error_rad(*result.motion), 1e-5);
  EXPECT_GT(result.motion->direction.dot(Eigen::Vector3d(1.5, 0.1, 2.0).normalized()), 1.0 - 1e-8);
  EXPECT_GE(result.inliers, 140);
}

// [Lu2015 5.2]
TEST(FivePointMotion, FindsTheRotationAtTheLandmarksOwnPlaceWhereThereIsNoWay) {
  const Views views(Eigen::Vector3d::Zero(), 0.003);
  const auto result = estimate_five_point_motion(views.panorama, views.landmark, kHeading_rad, {});
  ASSERT_TRUE(result.motion) << result.reason;
  EXPECT_LT(views.rotation_error_rad(*result.motion), 0.004);
}

// [Lu2015 5.2]
TEST(FivePointMotion, IsNotMisledByAThirdOfWrongMatches) {
  Views views({1.5, 0.1, 2.0}, 0.002);
  views.disturb(3);
  const auto result = estimate_five_point_motion(views.panorama, views.landmark, kHeading_rad, {});
  ASSERT_TRUE(result.motion) << result.reason;
  EXPECT_LT(views.rotation_error_rad(*result.motion), 0.003);
  EXPECT_LT(result.inliers, 120);
}

// [Lu2015 5.2]
TEST(FivePointMotion, HasACovarianceThatItsErrorsFollow) {
  FivePointParameters parameters;
  const double uniform_rad = parameters.bearing_sigma_deg * M_PI / 180.0 * std::sqrt(3.0);
  double sum = 0.0;
  constexpr int kTrials = 30;
  for (unsigned trial = 0; trial < kTrials; ++trial) {
    const Views views({0.5, 0.0, 1.0}, uniform_rad * std::sqrt(2.0), 0.03, 100 + trial);  // noise of both views in one
    const auto result = estimate_five_point_motion(views.panorama, views.landmark, kHeading_rad, parameters);
    ASSERT_TRUE(result.motion) << result.reason;
    const Eigen::Vector3d error =
        vision::so3_log(views.landmark_from_panorama.linear() * result.motion->rotation.transpose());
    sum += error.dot(result.motion->covariance.ldlt().solve(error));
  }
  EXPECT_GT(sum / kTrials, 1.0);  // three degrees of freedom
  EXPECT_LT(sum / kTrials, 6.0);
}

// [Lu2015 5.2]
TEST(FivePointMotion, IsRefusedWhereTheRotationIsNotSmallAgainstTheHeading) {
  const Views views({1.5, 0.1, 2.0}, 0.0, 0.4);
  const auto result = estimate_five_point_motion(views.panorama, views.landmark, kHeading_rad, {});
  EXPECT_FALSE(result.motion);
  EXPECT_NE(result.reason.find("needed"), std::string::npos) << result.reason;
}

// [Lu2015 5.2]
TEST(FivePointMotion, IsRefusedWhereTooFewAgree) {
  Views views({1.5, 0.1, 2.0});
  std::vector<Keypoint> few(views.panorama.begin(), views.panorama.begin() + 15);
  const auto result = estimate_five_point_motion(few, views.landmark, kHeading_rad, {});
  EXPECT_FALSE(result.motion);
  EXPECT_EQ(result.reason, "15 matched keypoints of 20 needed");
}

// [Lu2015 5.2]
TEST(FivePointMotion, IsTheSameBitForBit) {
  Views views({1.5, 0.1, 2.0}, 0.003);
  views.disturb(4);
  const auto first = estimate_five_point_motion(views.panorama, views.landmark, kHeading_rad, {});
  const auto second = estimate_five_point_motion(views.panorama, views.landmark, kHeading_rad, {});
  ASSERT_TRUE(first.motion && second.motion);
  EXPECT_TRUE((first.motion->rotation.array() == second.motion->rotation.array()).all());
  EXPECT_TRUE((first.motion->covariance.array() == second.motion->covariance.array()).all());
}

}  // namespace
}  // namespace panvo::position_corrector
