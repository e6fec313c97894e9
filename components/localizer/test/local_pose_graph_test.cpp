// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/local_pose_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace panvo::localizer {
namespace {

constexpr double kLap_m = 200.0;

Eigen::Isometry3d at_x(double x) { return Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0)); }

vision::Matrix6d variance(double sigma) { return sigma * sigma * vision::Matrix6d::Identity(); }

/// A vehicle on repeated laps. Odometry returns 0.1 m farther ahead after each lap, with a covariance of that size.
OdometrySample in_lap(int lap) {
  OdometrySample at;
  at.pose.stamp_ns = 1'000'000'000LL * (1 + 40 * lap);
  at.pose.odom_from_base = at_x(0.1 * lap);
  at.pose.covariance = variance(0.1 * std::sqrt(lap + 1.0));
  at.way_m = kLap_m * (1 + lap);
  return at;
}

LandmarkSighting sighting_in_lap(int lap) {
  LandmarkSighting sighting;
  sighting.stamp_ns = in_lap(lap).pose.stamp_ns;
  sighting.landmark_id = 1;
  sighting.landmark_from_base = at_x(0.0);
  sighting.covariance = variance(lap == 3 ? 0.01 : 0.02);
  return sighting;
}

TEST(LocalPoseGraph, StaysSmallWhereOneRouteIsDrivenAllDay) {
  LocalPoseGraph graph(0.01, 0.001, 0.0, {});
  graph.start({});
  graph.add_built(1, in_lap(0));
  std::size_t after_ten = 0;
  for (int lap = 1; lap <= 60; ++lap) {
    ASSERT_TRUE(graph.add_pass(sighting_in_lap(lap), in_lap(lap), 20.0)) << lap;
    ASSERT_TRUE(graph.solve()) << lap;
    if (lap == 10) after_ten = graph.size();
  }
  EXPECT_EQ(graph.size(), after_ten);
  // The last sighting removes the drift of 60 laps down to the error of the landmark and a sighting.
  const auto here = graph.carried(in_lap(60).pose);
  EXPECT_LT(here.map_from_base.translation().norm(), 0.3);
}

TEST(LocalPoseGraph, SaysWhereItCannotBeSolved) {
  LocalPoseGraph graph(0.01, 0.001, 0.0, {});
  graph.start({});
  KnownLandmark known;
  known.id = 1;
  known.covariance = variance(std::nan(""));
  graph.add_known(known);
  ASSERT_TRUE(graph.add_pass(sighting_in_lap(1), in_lap(1), 20.0));
  EXPECT_FALSE(graph.solve());
}

}  // namespace
}  // namespace panvo::localizer
