// SPDX-License-Identifier: Apache-2.0
#include "panvo/places/metric_places.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "made_up_view.hpp"

namespace panvo::places {
namespace {

using test::MadeUpScene;

constexpr double kQuarterTurn = 0.5 * std::numbers::pi;

/// Right, down, ahead of a panorama in the axes of the base.
Eigen::Isometry3d base_axes() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return pose;
}

Eigen::Isometry3d base_at(double x_m, double y_m, double heading_rad) {
  return Eigen::Isometry3d(Eigen::Translation3d(x_m, y_m, 0.0)) *
         Eigen::Isometry3d(Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()));
}

/// View of a base with this pose, in a scene given in the axes of a panorama at the map's origin.
std::vector<landmarks::Keypoint> view_from(MadeUpScene& scene, const Eigen::Isometry3d& map_from_base) {
  return scene.view(base_axes().inverse() * map_from_base * base_axes(), 0.1);
}

class MetricPlaces : public testing::Test {
 protected:
  void SetUp() override {
    scene_.add_things(150);
    for (const double x_m : {0.0, 1.0, 2.0}) {
      KnownPlace place;
      place.map_from_base = base_at(x_m, 0.0, 0.3 * x_m);
      place.keypoints = view_from(scene_, *place.map_from_base);
      places_.push_back(place);
    }
  }
  MadeUpScene scene_{70};
  std::vector<KnownPlace> places_;
};

TEST_F(MetricPlaces, GivePositionsInMetresByThePosesOfTheLibrary) {
  ASSERT_EQ(triangulate_places(places_), 3);
  const auto truth = base_at(0.8, -1.1, kQuarterTurn);
  const auto found = metric_position(view_from(scene_, truth), places_[1], kQuarterTurn - 0.3);
  ASSERT_TRUE(found);
  EXPECT_LT((found->map_from_base.translation() - truth.translation()).norm(), 0.1);
  EXPECT_LT(found->sigma_m, 0.1);
  EXPECT_TRUE(found->map_from_base.linear().isApprox(truth.linear(), 0.02));
}

TEST_F(MetricPlaces, GiveNoneWithoutPoses) {
  for (auto& place : places_) place.map_from_base.reset();
  EXPECT_EQ(triangulate_places(places_), 0);
  EXPECT_FALSE(metric_position(view_from(scene_, base_at(0.5, 0.0, 0.0)), places_[0], 0.0));
}

TEST_F(MetricPlaces, GiveNoneFromPosesFarApart) {
  places_[1].map_from_base = base_at(40.0, 0.0, 0.0);
  places_[2].map_from_base = base_at(80.0, 0.0, 0.0);
  EXPECT_EQ(triangulate_places(places_), 0);
}

}  // namespace
}  // namespace panvo::places
