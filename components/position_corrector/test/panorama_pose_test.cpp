// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/panorama_pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace panvo::position_corrector {
namespace {

using landmarks::Keypoint;

/// A landmark's keypoints with points, and the same points seen from another position.
class Place {
 public:
  Place() {
    seen_from.translation() = Eigen::Vector3d(2.0, 0.05, 3.0);
    seen_from.linear() = vision::so3_exp(Eigen::Vector3d(0.0, -kHeading_rad, 0.0));
    for (int i = 0; i < 120; ++i) add();
  }

  static constexpr double kHeading_rad = 2.2;  // to the left: about -Y

  std::vector<Keypoint> landmark, panorama;
  Eigen::Isometry3d seen_from = Eigen::Isometry3d::Identity();

 private:
  void add() {
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    const double azimuth = M_PI * any(random_);
    const double range = 18.0 + 10.0 * any(random_);
    const Eigen::Vector3d point(range * std::sin(azimuth), -3.0 + 4.0 * any(random_), range * std::cos(azimuth));
    Keypoint known;
    known.bearing = point.normalized().cast<float>();
    known.has_point = true;
    known.point_in_panorama = point.cast<float>();
    known.inverse_range_sigma = 0.002F;
    for (auto& byte : known.descriptor) byte = static_cast<std::uint8_t>(random_() % 90);
    landmark.push_back(known);
    Keypoint seen = known;
    seen.has_point = false;
    std::normal_distribution<double> normal;
    const Eigen::Vector3d noise{normal(random_), normal(random_), normal(random_)};
    seen.bearing = ((seen_from.inverse() * point).normalized() + 0.003 * noise).normalized().cast<float>();
    panorama.push_back(seen);
  }

  std::mt19937_64 random_{7};
};

TEST(PanoramaPose, HasTheTurnLeftAsItsHeading) {
  const Eigen::Matrix3d left = vision::so3_exp(Eigen::Vector3d(0.0, -0.5, 0.0));  // Y points down: left is about -Y
  EXPECT_NEAR(heading_of(left), 0.5, 1e-12);
  EXPECT_NEAR(heading_of(left.transpose()), -0.5, 1e-12);
}

TEST(PanoramaPose, IsFoundFromThePointsOfALandmarkSeenElsewhereUnderAnotherHeading) {
  const Place place;
  const auto result = estimate_panorama_pose(place.panorama, place.landmark, Place::kHeading_rad + 0.05, {});
  ASSERT_TRUE(result.pose) << result.reason;
  const auto error = vision::pose_error(result.pose->landmark_from_panorama, place.seen_from);
  EXPECT_LT(error.head<3>().norm(), 0.1);
  EXPECT_LT(error.tail<3>().norm(), 0.005);
  EXPECT_NEAR(result.pose->heading_rad, Place::kHeading_rad, 0.005);
  EXPECT_LT(error.dot(result.pose->covariance.ldlt().solve(error)), 22.5);  // 99.9 % of chi-square with six degrees
  EXPECT_GE(result.inliers, 100);
}

TEST(PanoramaPose, TellsWhichPointsAgreeWithItAndWhereThePanoramaShowsThem) {
  Place place;
  for (const std::size_t wrong : {3U, 90U}) {
    auto& bearing = place.panorama[wrong].bearing;
    bearing = Eigen::AngleAxisf(0.1F, Eigen::Vector3f::UnitY()) * bearing;
  }
  const auto result = estimate_panorama_pose(place.panorama, place.landmark, Place::kHeading_rad, {});
  ASSERT_TRUE(result.pose) << result.reason;
  int agreeing = 0;
  for (const auto& match : result.points) {
    const Eigen::Vector3d expected = (place.seen_from.inverse() * match.point).normalized();
    EXPECT_EQ(match.agrees, expected.dot(match.bearing) > std::cos(0.03)) << match.point.transpose();
    agreeing += match.agrees ? 1 : 0;
  }
  EXPECT_EQ(agreeing, result.inliers);
  EXPECT_EQ(result.points.size(), static_cast<std::size_t>(agreeing) + 2U);
  EXPECT_TRUE(estimate_panorama_pose({}, place.landmark, 0.0, {}).points.empty());
}

/// Eight directions and heights all round with `times` points each, with unique descriptors, seen without error.
std::vector<Keypoint> eight_points(int times) {
  std::mt19937_64 random(5);
  std::vector<Keypoint> points;
  for (int i = 0; i < 8 * times; ++i) {
    const double azimuth = M_PI / 4.0 * (i % 8);
    const Eigen::Vector3d point(15.0 * std::sin(azimuth), -1.0 - 0.9 * (i % 8), 15.0 * std::cos(azimuth));
    Keypoint known;
    known.bearing = point.normalized().cast<float>();
    known.has_point = true;
    known.point_in_panorama = point.cast<float>();
    known.inverse_range_sigma = 0.002F;
    for (auto& byte : known.descriptor) byte = static_cast<std::uint8_t>(random() % 90);
    points.push_back(known);
  }
  return points;
}

TEST(PanoramaPose, IsLessSureOfFewPointsThanTheirNumberSaysForTheyWereChosenBecauseTheyAgree) {
  const auto few = eight_points(1), many = eight_points(12);
  const PanoramaPoseParameters all_count{.spare_points = 0};
  const auto by_few = estimate_panorama_pose(few, few, 0.0, all_count);
  const auto by_many = estimate_panorama_pose(many, many, 0.0, all_count);
  ASSERT_TRUE(by_few.weak_pose) << by_few.reason;
  ASSERT_TRUE(by_many.pose) << by_many.reason;
  ASSERT_EQ(by_few.inliers, 8);
  ASSERT_EQ(by_many.inliers, 96);
  // the selection leaves 4 of 10 degrees of freedom, or 180 of 186
  const double expected = 12.0 * (10.0 / 4.0) / (186.0 / 180.0);
  EXPECT_NEAR(by_few.weak_pose->covariance.trace() / by_many.pose->covariance.trace(), expected, 0.01 * expected);
}

TEST(PanoramaPose, IsTheSameBitForBit) {
  const Place place;
  const auto first = estimate_panorama_pose(place.panorama, place.landmark, Place::kHeading_rad, {});
  const auto second = estimate_panorama_pose(place.panorama, place.landmark, Place::kHeading_rad, {});
  ASSERT_TRUE(first.pose && second.pose);
  EXPECT_TRUE(
      (first.pose->landmark_from_panorama.matrix().array() == second.pose->landmark_from_panorama.matrix().array())
          .all());
}

TEST(PanoramaPose, IsRefusedWhereThingsLookAlikeButLieElsewhere) {
  Place place;
  // shuffled descriptors, like repeated facades
  std::mt19937_64 random(11);
  for (auto& seen : place.panorama) {
    const double azimuth = M_PI * (2.0 * static_cast<double>(random() % 1000) / 999.0 - 1.0);
    seen.bearing = Eigen::Vector3d(std::sin(azimuth), -0.1, std::cos(azimuth)).normalized().cast<float>();
  }
  const auto result = estimate_panorama_pose(place.panorama, place.landmark, Place::kHeading_rad, {});
  EXPECT_FALSE(result.pose);
  EXPECT_NE(result.reason.find("needed"), std::string::npos) << result.reason;
}

TEST(PanoramaPose, IsRefusedWhereThePoseTurnsAwayFromTheHeading) {
  const Place place;
  PanoramaPoseParameters parameters;
  parameters.azimuth_window_deg = 90.0;
  const auto result = estimate_panorama_pose(place.panorama, place.landmark, Place::kHeading_rad + 0.7, parameters);
  EXPECT_FALSE(result.pose);
  EXPECT_NE(result.reason.find("heading"), std::string::npos) << result.reason;
}

TEST(PanoramaPose, IsRefusedWhereAllThatAgreesStandsInOneDirection) {
  Place place;
  std::vector<Keypoint> seen;
  for (const auto& keypoint : place.panorama) {  // a single building of that shape
    if (std::abs(std::atan2(keypoint.bearing.x(), keypoint.bearing.z())) < 0.5F) seen.push_back(keypoint);
  }
  ASSERT_GE(seen.size(), 12U);
  const auto result = estimate_panorama_pose(seen, place.landmark, Place::kHeading_rad, {});
  EXPECT_FALSE(result.pose);
  EXPECT_NE(result.reason.find("sectors"), std::string::npos) << result.reason;
}

/// Points of a roof with its beams and of a floor, and `others` between them, all seen where they are.
std::vector<Keypoint> roof_and_floor(int others) {
  std::vector<Keypoint> points = eight_points(4);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_roof = i % 2 == 0;
    points[i].point_in_panorama.y() = is_roof ? -5.3F + 0.1F * static_cast<float>(i % 7) : 1.9F;
  }
  const auto between = eight_points(3);
  points.insert(points.end(), between.begin(), between.begin() + others);
  for (auto& point : points) point.bearing = point.point_in_panorama.normalized();
  return points;
}

TEST(PanoramaPose, IsRefusedWhereNothingButARoofAndAFloorAgree) {
  const auto hall = roof_and_floor(0), with_goods = roof_and_floor(12);
  const auto refused = estimate_panorama_pose(hall, hall, 0.0, {});
  EXPECT_FALSE(refused.pose || refused.weak_pose);
  EXPECT_NE(refused.reason.find("layers"), std::string::npos) << refused.reason;
  EXPECT_TRUE(estimate_panorama_pose(with_goods, with_goods, 0.0, {}).pose);
  PanoramaPoseParameters without;
  without.layer_m = 0.0;
  EXPECT_TRUE(estimate_panorama_pose(hall, hall, 0.0, without).pose);
}

TEST(PanoramaPose, OfFewPointsIsAWeakOne) {
  Place place;
  place.panorama.resize(10);
  const auto result = estimate_panorama_pose(place.panorama, place.landmark, Place::kHeading_rad, {});
  EXPECT_FALSE(result.pose);
  EXPECT_NE(result.reason.find("of 12 needed"), std::string::npos) << result.reason;
  ASSERT_TRUE(result.weak_pose);
  const auto error = vision::pose_error(result.weak_pose->landmark_from_panorama, place.seen_from);
  EXPECT_LT(error.head<3>().norm(), 0.5);
  place.panorama.resize(6);
  EXPECT_FALSE(estimate_panorama_pose(place.panorama, place.landmark, Place::kHeading_rad, {}).weak_pose);
}

TEST(PanoramaPose, OfFewPointsSaysWhyItIsNotEvenAWeakOne) {
  Place place;
  place.panorama.resize(10);
  PanoramaPoseParameters parameters;
  parameters.azimuth_window_deg = 90.0;
  const auto result = estimate_panorama_pose(place.panorama, place.landmark, Place::kHeading_rad + 0.7, parameters);
  EXPECT_FALSE(result.pose);
  EXPECT_FALSE(result.weak_pose);
  EXPECT_NE(result.reason.find("heading"), std::string::npos) << result.reason;
}

TEST(PanoramaPose, SaysThatALandmarkWithoutPointsGivesNone) {
  Place place;
  for (auto& known : place.landmark) known.has_point = false;
  const auto result = estimate_panorama_pose(place.panorama, place.landmark, Place::kHeading_rad, {});
  EXPECT_FALSE(result.pose);
  EXPECT_EQ(result.reason, "0 matched points of 12 needed");
}

}  // namespace
}  // namespace panvo::position_corrector
