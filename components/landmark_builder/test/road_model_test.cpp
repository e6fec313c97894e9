// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/road_model.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "painted_town.hpp"
#include "panvo/landmark_builder/body_mask.hpp"
#include "panvo/landmark_builder/road_map.hpp"

namespace panvo::landmark_builder {
namespace {

const cv::Rect kRoad(0, 0, 60, 40), kShadow(60, 0, 40, 40), kGrass(0, 40, 100, 60);

/// A road, half of it in shadow, and grass, with camera noise.
cv::Mat ground(bool has_colour = true) {
  cv::Mat view(100, 100, CV_8UC3);
  view(kRoad).setTo(cv::Scalar(120, 120, 124));
  view(kShadow).setTo(cv::Scalar(52, 50, 48));
  view(kGrass).setTo(cv::Scalar(60, 110, 80));
  cv::Mat noise(view.size(), CV_16SC3);
  cv::RNG random(1);
  random.fill(noise, cv::RNG::NORMAL, 0.0, 6.0);
  if (!has_colour) random.fill(noise(kGrass), cv::RNG::NORMAL, 0.0, 40.0);
  cv::add(view, noise, view, cv::noArray(), CV_8UC3);
  if (!has_colour) cv::cvtColor(view, view, cv::COLOR_BGR2GRAY);
  return view;
}

double share_of_road(const RoadModel& model, const cv::Mat& view, const cv::Rect& where) {
  const cv::Mat road = model.segment(view)(where) > 0.0F;
  return static_cast<double>(cv::countNonZero(road)) / where.area();
}

TEST(ColourMixture, FindsTheModesOfItsSamples) {  // [Lu2015 4.1]
  ColourMixture mixture(5, {1e-3F, 1e-3F, 1e-3F});
  std::vector<GroundColour> samples;
  cv::RNG random(3);
  for (int i = 0; i < 600; ++i) {
    const float centre = i % 3 == 0 ? 1.0F : 4.0F;
    const auto sample = [&] { return centre + static_cast<float>(random.gaussian(0.1)); };
    samples.push_back({sample(), sample(), sample()});
  }
  for (int i = 0; i < 20; ++i) mixture.learn(samples, i == 0 ? 1.0 : 0.2);
  ASSERT_GE(mixture.gaussians().size(), 2U);
  EXPECT_NEAR(mixture.gaussians()[0].mean[0], 4.0F, 0.05F);
  EXPECT_NEAR(mixture.gaussians()[1].mean[0], 1.0F, 0.05F);
  EXPECT_NEAR(mixture.gaussians()[0].weight, 2.0 / 3.0, 0.1);
  EXPECT_NEAR(mixture.gaussians()[0].variance[1], 0.01F, 0.005F);
}

TEST(RoadModel, KnowsNothingBeforeItHasLearned) { EXPECT_EQ(cv::countNonZero(RoadModel({}).segment(ground())), 0); }

TEST(RoadModel, TellsRoadFromGrassAndLearnsThatShadowIsRoadToo) {  // [Lu2015 4.1]
  RoadModel model({});
  const cv::Mat view = ground();
  cv::Mat certain = cv::Mat::zeros(view.size(), CV_8UC1);
  certain(cv::Rect(10, 10, 40, 20)).setTo(255);
  for (int i = 0; i < 5; ++i) model.learn(view, certain);
  EXPECT_GT(share_of_road(model, view, kRoad), 0.9);
  EXPECT_LT(share_of_road(model, view, kGrass), 0.05);
  EXPECT_LT(share_of_road(model, view, kShadow), 0.5);
  certain(cv::Rect(60, 10, 30, 20)).setTo(255);  // the vehicle has driven through the shadow
  for (int i = 0; i < 80; ++i) model.learn(view, certain);
  EXPECT_GT(share_of_road(model, view, kShadow), 0.65);
  EXPECT_LT(share_of_road(model, view, kGrass), 0.05);
}

TEST(RoadModel, TellsSmoothRoadFromRoughGrassWithoutColour) {
  RoadModel model({});
  const cv::Mat view = ground(false);
  cv::Mat certain = cv::Mat::zeros(view.size(), CV_8UC1);
  certain(cv::Rect(10, 10, 40, 20)).setTo(255);
  for (int i = 0; i < 5; ++i) model.learn(view, certain);
  EXPECT_GT(share_of_road(model, view, kRoad), 0.9);
  EXPECT_LT(share_of_road(model, view, kGrass), 0.3);
}

TEST(RoadModel, RefusesWhatIsNoView) {
  RoadModel model({});
  EXPECT_THROW(model.segment(cv::Mat()), std::invalid_argument);
  EXPECT_THROW(model.learn(ground(), cv::Mat(10, 10, CV_8UC1)), std::invalid_argument);
}

TEST(BodyMask, LearnsWhatStaysWhereItIsWhileTheGroundGoesBy) {
  const PaintedTown town = PaintedTown::star({0.0, M_PI});
  const GroundProjection projection({}, PaintedTown::base_from_panorama(), {1080, 540});
  BodyMask body({.ahead_m = 1.0, .behind_m = 1.0, .side_m = 1.0}, projection.grid());
  const auto covered_m2 = [&] { return cv::countNonZero(body.mask()) * std::pow(projection.grid().resolution_m, 2.0); };
  EXPECT_NEAR(covered_m2(), M_PI, 0.5);
  for (int i = 0; i < 20; ++i) {
    const auto pose = PaintedTown::at(0.6 * i, 0.0, 0.0);
    body.learn(projection.project(town.panorama(pose)), PlanarPose::of(pose));
  }
  const double radius_m = 2.0 * std::sqrt(1.0 - 0.75 * 0.75) / 0.75;  // edge of the painted body
  EXPECT_GT(covered_m2(), 0.8 * M_PI * radius_m * radius_m);
  EXPECT_LT(covered_m2(), 4.0 * M_PI * radius_m * radius_m);
}

TEST(RoadMap, KeepsWhatWasSeenWhereItIs) {
  RoadMap map({}, 0.25);
  const GroundGrid grid{177, 0.25};
  const Eigen::Vector2d mark(8.0, 3.0);  // odometry frame
  for (const auto& [x, yaw] : {std::pair{0.0, 0.0}, std::pair{3.0, 0.5}, std::pair{7.0, -2.0}}) {
    const PlanarPose pose{{x, 1.0}, yaw};
    cv::Mat ratio(grid.side, grid.side, CV_32FC1, cv::Scalar(-1.0)), weight(ratio.size(), CV_32FC1, cv::Scalar(1.0));
    const Eigen::Vector2d pixel = grid.pixel(pose.to_base(mark));
    cv::circle(ratio, cv::Point(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y()))), 4,
               2.0F, cv::FILLED);
    map.add(ratio, weight, grid, pose);
    const Eigen::Vector2d cell = map.cell(mark);
    EXPECT_GT(
        map.evidence().at<float>(static_cast<int>(std::lround(cell.y())), static_cast<int>(std::lround(cell.x()))),
        1.0F);
    EXPECT_TRUE(map.point(cell).isApprox(mark));
  }
  const Eigen::Vector2d cell = map.cell({8.0, -1.0});
  EXPECT_LT(map.evidence().at<float>(static_cast<int>(std::lround(cell.y())), static_cast<int>(std::lround(cell.x()))),
            -1.0F);
}

TEST(PlanarPose, TakesPointsBackAndForth) {
  const PlanarPose pose = PlanarPose::of(PaintedTown::at(3.0, -2.0, 0.7));
  EXPECT_NEAR(pose.yaw_rad, 0.7, 1e-12);
  EXPECT_TRUE(pose.to_base(pose.to_odom({4.0, 5.0})).isApprox(Eigen::Vector2d(4.0, 5.0)));
  EXPECT_TRUE(pose.to_odom({1.0, 0.0}).isApprox(Eigen::Vector2d(3.0 + std::cos(0.7), -2.0 + std::sin(0.7))));
}

}  // namespace
}  // namespace panvo::landmark_builder
