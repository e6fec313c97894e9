// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/road_junction_detector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "painted_town.hpp"
#include "panvo/landmark_builder/drawing.hpp"

namespace panvo::landmark_builder {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr int kColumns = 720;

struct Drive {
  std::vector<PassedJunction> passed;
  int max_roads = 0;
  JunctionView last;
};

/// Drives along the road from -x through the origin.
Drive drive(const PaintedTown& town, const JunctionDetectorParameters& parameters = {}, bool is_grey = false) {
  RoadJunctionDetector detector(parameters, PaintedTown::base_from_panorama(), {kColumns, kColumns / 2});
  JunctionFilter filter({});
  Drive result;
  std::int64_t stamp_ns = 0;
  for (double x = -30.0; x < 25.0; x += 1.0) {
    const auto pose = PaintedTown::at(x, -1.5, 0.0);
    cv::Mat panorama = town.panorama(pose, kColumns);
    if (is_grey) cv::extractChannel(panorama, panorama, 1);
    result.last = detector.detect(panorama, pose);
    if (result.last.seen) result.max_roads = std::max(result.max_roads, result.last.seen->roads);
    for (const auto& junction : filter.add(++stamp_ns, {x, -1.5}, result.last.seen)) result.passed.push_back(junction);
  }
  return result;
}

TEST(RoadJunctionDetector, FindsACrossing) {  // [Lu2015 4.1]
  const Drive result = drive(PaintedTown::star({0.0, 0.5 * M_PI, M_PI, 1.5 * M_PI}));
  ASSERT_THAT(result.passed, SizeIs(1));
  EXPECT_LT(result.passed[0].centre_in_odom.norm(), 3.0);
  EXPECT_NEAR(static_cast<double>(result.passed[0].nearest_stamp_ns), 31.0, 3.0);
  EXPECT_EQ(result.max_roads, 4);
}

TEST(RoadJunctionDetector, FindsAT) {
  const Drive result = drive(PaintedTown::star({0.0, 0.5 * M_PI, M_PI}));
  ASSERT_THAT(result.passed, SizeIs(1));
  EXPECT_LT(result.passed[0].centre_in_odom.norm(), 3.5);
  EXPECT_EQ(result.max_roads, 3);
}

TEST(RoadJunctionDetector, FindsNoneOnAStraightRoadNorWhereOneBends) {
  EXPECT_THAT(drive(PaintedTown::star({0.0, M_PI})).passed, IsEmpty());
  EXPECT_THAT(drive(PaintedTown({{{-80.0, 0.0}, {5.0, 0.0}}, {{5.0, 0.0}, {60.0, 60.0}}})).passed, IsEmpty());
}

TEST(RoadJunctionDetector, OnePanoramaByItselfShowsACrossingToo) {
  JunctionDetectorParameters parameters;
  parameters.gather = false;
  EXPECT_THAT(drive(PaintedTown::star({0.0, 0.5 * M_PI, M_PI, 1.5 * M_PI}), parameters).passed, SizeIs(1));
}

TEST(RoadJunctionDetector, ByThePapersCriterionFindsACrossingInTheRadonField) {  // [Lu2015 4.1]
  JunctionDetectorParameters parameters;
  parameters.criterion = "radon";
  parameters.gather = false;
  EXPECT_GE(drive(PaintedTown::star({0.0, 0.5 * M_PI, M_PI, 1.5 * M_PI}), parameters).passed.size(), 1U);
  EXPECT_THAT(drive(PaintedTown::star({0.0, M_PI}), parameters).passed, IsEmpty());
}

TEST(RoadJunctionDetector, SeesTheSameTwice) {
  const PaintedTown town = PaintedTown::star({0.0, 0.5 * M_PI, M_PI});
  const Drive first = drive(town), second = drive(town);
  EXPECT_EQ(cv::norm(first.last.road_ratio, second.last.road_ratio, cv::NORM_INF), 0.0);
  ASSERT_EQ(first.passed.size(), second.passed.size());
  EXPECT_EQ(first.passed[0].centre_in_odom, second.passed[0].centre_in_odom);
}

TEST(RoadJunctionDetector, FindsNothingInTheDark) {
  RoadJunctionDetector detector({}, PaintedTown::base_from_panorama(), {kColumns, kColumns / 2});
  for (int i = 0; i < 10; ++i) {
    const auto view =
        detector.detect(cv::Mat(kColumns / 2, kColumns, CV_8UC3, cv::Scalar(0, 0, 0)), PaintedTown::at(i, 0.0, 0.0));
    EXPECT_FALSE(view.seen);
  }
}

TEST(RoadJunctionDetector, RefusesAPanoramaOfAnotherSize) {
  RoadJunctionDetector detector({}, PaintedTown::base_from_panorama(), {kColumns, kColumns / 2});
  EXPECT_THROW(detector.detect(cv::Mat(100, 200, CV_8UC3), Eigen::Isometry3d::Identity()), std::invalid_argument);
}

TEST(Drawing, ShowsEveryStepForBothCriteria) {
  for (const char* criterion : {"arms", "radon"}) {
    JunctionDetectorParameters parameters;
    parameters.criterion = criterion;
    RoadJunctionDetector detector(parameters, PaintedTown::base_from_panorama(), {kColumns, kColumns / 2});
    const auto pose = PaintedTown::at(-3.0, 0.0, 0.0);
    const auto view = detector.detect(PaintedTown::star({0.0, 2.0, 4.0}).panorama(pose, kColumns), pose);
    const cv::Mat picture = draw_junction_view(view, parameters, 2);
    const int side = 2 * detector.grid().side;
    EXPECT_EQ(picture.size(), cv::Size(4 * side, side));
    EXPECT_EQ(picture.type(), CV_8UC3);
  }
}

}  // namespace
}  // namespace panvo::landmark_builder
