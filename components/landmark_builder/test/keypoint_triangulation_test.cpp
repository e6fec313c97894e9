// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/keypoint_triangulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "panvo/vision/pose.hpp"

namespace panvo::landmark_builder {
namespace {

using landmarks::Keypoint;

/// Points around a landmark, seen from it and from positions along the road past it.
class Street {
 public:
  Street(int things, double sigma_rad, unsigned seed) : random_(seed) {
    for (const double way : {-3.0, -2.0, 2.0, 3.0}) {
      NeighbourPanorama neighbour;
      neighbour.landmark_from_neighbour.translation() = Eigen::Vector3d(0.05 * way, 0.01, way);
      neighbour.landmark_from_neighbour.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.04 * way, 0.0));
      neighbours.push_back(neighbour);
    }
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int i = 0; i < things; ++i) {
      const double azimuth = M_PI * any(random_);
      const double range = 14.0 + 8.0 * any(random_);
      points.emplace_back(range * std::sin(azimuth), -2.0 + 3.0 * any(random_), range * std::cos(azimuth));
      Keypoint keypoint;
      for (auto& byte : keypoint.descriptor) byte = static_cast<std::uint8_t>(random_() % 90);
      keypoint.bearing = seen(points.back(), sigma_rad);
      landmark.push_back(keypoint);
      for (auto& neighbour : neighbours) {
        keypoint.bearing = seen(neighbour.landmark_from_neighbour.inverse() * points.back(), sigma_rad);
        neighbour.keypoints.push_back(keypoint);
      }
    }
  }

  std::vector<Eigen::Vector3d> points;
  std::vector<Keypoint> landmark;
  std::vector<NeighbourPanorama> neighbours;

 private:
  Eigen::Vector3f seen(const Eigen::Vector3d& point, double sigma_rad) {
    std::normal_distribution<double> normal(0.0, 1.0);
    const Eigen::Vector3d noise{normal(random_), normal(random_), normal(random_)};
    return (point.normalized() + sigma_rad * noise).normalized().cast<float>();
  }

  std::mt19937_64 random_;
};

TEST(KeypointTriangulation, FindsWhereThingsStandFromExactBearings) {
  Street street(60, 0.0, 1);
  EXPECT_GE(triangulate_keypoints(street.landmark, street.neighbours, {}), 55);
  for (std::size_t i = 0; i < street.landmark.size(); ++i) {
    if (!street.landmark[i].has_point) continue;
    EXPECT_LT((street.landmark[i].point_in_panorama.cast<double>() - street.points[i]).norm(), 0.01);
  }
}

TEST(KeypointTriangulation, SaysHowFarTheInverseRangeMayErr) {
  Street street(400, 0.25 * M_PI / 180.0, 2);
  triangulate_keypoints(street.landmark, street.neighbours, {});
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < street.landmark.size(); ++i) {
    const auto& keypoint = street.landmark[i];
    const double sideways = std::hypot(street.points[i].x(), street.points[i].y());
    if (!keypoint.has_point || sideways < 5.0)
      continue;  // ahead and behind there is no parallax, and selection biases the range
    const double error = 1.0 / keypoint.point_in_panorama.cast<double>().norm() - 1.0 / street.points[i].norm();
    sum += error * error / (keypoint.inverse_range_sigma * keypoint.inverse_range_sigma);
    ++count;
  }
  ASSERT_GT(count, 200);
  EXPECT_GT(sum / count, 0.4);
  EXPECT_LT(sum / count, 1.6);
}

TEST(KeypointTriangulation, GivesNoPointToWhatTheNeighboursDisagreeOn) {
  Street street(40, 0.0, 3);
  for (auto& neighbour : street.neighbours) {  // point 0 moves between the neighbours
    const double turn = 0.1 * neighbour.landmark_from_neighbour.translation().z();
    neighbour.keypoints[0].bearing =
        vision::so3_exp(Eigen::Vector3d(turn, 0.0, turn)).cast<float>() * neighbour.keypoints[0].bearing;
  }
  triangulate_keypoints(street.landmark, street.neighbours, {});
  EXPECT_FALSE(street.landmark[0].has_point);
}

TEST(KeypointTriangulation, SurvivesOneWrongMatchAmongFour) {
  Street street(40, 0.0, 4);
  auto& wrong = street.neighbours[1].keypoints[5].bearing;
  wrong = vision::so3_exp(Eigen::Vector3d(0.1, 0.05, 0.0)).cast<float>() * wrong;
  triangulate_keypoints(street.landmark, street.neighbours, {});
  ASSERT_TRUE(street.landmark[5].has_point);
  EXPECT_LT((street.landmark[5].point_in_panorama.cast<double>() - street.points[5]).norm(), 0.01);
}

TEST(KeypointTriangulation, GivesNoPointToWhatIsTooFarForParallax) {
  Street street(1, 0.0, 5);
  const Eigen::Vector3d far(4000.0, -50.0, 100.0);
  street.landmark[0].bearing = far.normalized().cast<float>();
  for (auto& neighbour : street.neighbours) {
    neighbour.keypoints[0].bearing = (neighbour.landmark_from_neighbour.inverse() * far).normalized().cast<float>();
  }
  EXPECT_EQ(triangulate_keypoints(street.landmark, street.neighbours, {}), 0);
}

}  // namespace
}  // namespace panvo::landmark_builder
