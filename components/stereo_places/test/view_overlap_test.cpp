// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/view_overlap.hpp"

#include <gtest/gtest.h>

#include "made_up_keypoints.hpp"

namespace panvo::stereo_places {
namespace {

constexpr vision::PinholeCamera kCamera{400.0, 400.0, 319.5, 239.5, 640, 480};

std::vector<Eigen::Vector3d> points_of(const std::vector<landmarks::Keypoint>& keypoints) {
  std::vector<Eigen::Vector3d> points;
  for (const auto& keypoint : keypoints) points.push_back(keypoint.point_in_panorama.cast<double>());
  return points;
}

TEST(SharedView, IsWholeAtThePlaceAndNothingBehindIt) {
  const auto points = points_of(made_up_place(1));
  EXPECT_DOUBLE_EQ(shared_view(points, kCamera, moved(0.0)), 1.0);
  EXPECT_DOUBLE_EQ(shared_view(points, kCamera, moved(0.0, 3.1)), 0.0);
  EXPECT_DOUBLE_EQ(shared_view({}, kCamera, moved(0.0)), 0.0);
}

TEST(SharedView, ShrinksWithPathAndTurn) {
  const auto points = points_of(made_up_place(1, 1000));
  double last = 1.0;
  for (const double ahead_m : {2.0, 4.0, 7.0, 12.0}) {
    const double shared = shared_view(points, kCamera, moved(ahead_m));
    EXPECT_LT(shared, last);
    last = shared;
  }
  EXPECT_NEAR(shared_view(points, kCamera, moved(0.0, 0.55)), 0.62, 0.05);  // 37 of the 60 degrees with points
}

TEST(SharedView, LeavesOutWhatIsSeenAtAnotherScale) {
  const std::vector<Eigen::Vector3d> points{{0.0, 0.0, 9.0}, {0.0, 0.0, 30.0}};
  EXPECT_DOUBLE_EQ(shared_view(points, kCamera, moved(2.5)), 1.0);
  EXPECT_DOUBLE_EQ(shared_view(points, kCamera, moved(3.5)), 0.5);
  EXPECT_DOUBLE_EQ(shared_view(points, kCamera, moved(-5.0)), 0.5);
}

TEST(WithoutOwnBody, RemovesNearThingsThatMoveWithTheCamera) {
  auto keypoints = made_up_place(1, 30);
  auto before = seen_from(keypoints, moved(-1.0));
  auto bonnet = made_up_place(2, 5);
  for (auto& keypoint : bonnet) keypoint.point_in_panorama = Eigen::Vector3f(keypoint.bearing * 1.5F);
  keypoints.insert(keypoints.end(), bonnet.begin(), bonnet.end());
  before.insert(before.end(), bonnet.begin(), bonnet.end());
  EXPECT_EQ(without_own_body(keypoints, before, moved(1.0)).size(), 30U);
  EXPECT_EQ(without_own_body(keypoints, before, moved(0.0)).size(), 35U);  // at standstill everything stays
}

}  // namespace
}  // namespace panvo::stereo_places
