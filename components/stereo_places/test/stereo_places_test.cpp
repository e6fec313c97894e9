// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/stereo_places.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "made_up_keypoints.hpp"
#include "panvo/landmarks/panorama_describer.hpp"
#include "street.hpp"

namespace panvo::stereo_places {
namespace {

using position_corrector::MatchState;

/// X ahead, Y left, Z up from the camera's axes.
Eigen::Isometry3d base_from_left() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  pose.translation() << 1.5, 0.1, 1.3;
  return pose;
}

/// Drives through a street, again and again. The map's axes are those of the base at the street's origin.
class StereoPlacesTest : public testing::Test {
 protected:
  static Eigen::Isometry3d base_at(const Eigen::Isometry3d& world_from_left) {
    return base_from_left() * world_from_left * base_from_left().inverse();
  }

  ViewResult see(const Street& street, const Eigen::Isometry3d& world_from_left) {
    StereoView view;
    view.stamp_ns = stamp_ns += 400'000'000;
    view.left = street.left(world_from_left);
    view.right = street.right(world_from_left);
    view.odom_from_base = drift * base_at(world_from_left);
    view.way_m = way_m += 1.0;
    view.pose = {view.odom_from_base, sigma_m * sigma_m * vision::Matrix6d::Identity(), is_located};
    view.pose.covariance.bottomRightCorner<3, 3>() *= 0.01;
    return places.step(view);
  }

  std::vector<ViewResult> drive(const Street& street, double from_m, double to_m, double right_m = 0.0) {
    std::vector<ViewResult> results;
    for (double z_m = from_m; z_m <= to_m; z_m += 1.0) {
      results.push_back(see(street, moved(z_m, 0.02 * std::sin(z_m), right_m)));
      if (results.back().built) built.push_back(*results.back().built);
    }
    return results;
  }

  static int corrections(const std::vector<ViewResult>& results) {
    return static_cast<int>(std::count_if(results.begin(), results.end(),
                                          [](const auto& result) { return result.correction.has_value(); }));
  }

  Parameters parameters;
  StereoPlaces places{parameters, Street::stereo(), base_from_left(),
                      std::make_shared<position_corrector::SpilledLandmarks>("")};
  std::vector<landmarks::PanoramicLandmark> built;
  Eigen::Isometry3d drift = Eigen::Isometry3d::Identity();  // of the odometry
  std::int64_t stamp_ns = 0;
  double way_m = 0.0, sigma_m = 2.0;
  bool is_located = true;
};

TEST_F(StereoPlacesTest, BuildsAPlaceEveryFewMetresWithMetricPoints) {
  EXPECT_EQ(corrections(drive(Street(), 0.0, 9.0)), 0);
  ASSERT_GE(built.size(), 2U);
  ASSERT_LE(built.size(), 6U);
  for (const auto& landmark : built) {
    EXPECT_GT(landmark.keypoints.size(), 50U);
    EXPECT_FALSE(landmark.thumbnail.empty());
    EXPECT_EQ(landmark.description.histogram.size(), 64U);
    EXPECT_TRUE(landmark.base_from_panorama.isApprox(base_from_left()));
  }
  EXPECT_EQ(built[0].id, 1U);
  EXPECT_EQ(built[1].id, 2U);
}

TEST_F(StereoPlacesTest, CorrectsTheDriftAtTheNextPass) {
  drive(Street(), 0.0, 9.0);
  way_m += 100.0;
  drift = Eigen::Translation3d(1.2, -0.8, 0.1) * Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitZ());
  const auto count = built.size();
  const auto results = drive(Street(), 0.5, 9.0, 0.4);
  EXPECT_GE(corrections(results), 3);
  EXPECT_EQ(built.size(), count);  // nothing new here
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i].correction) continue;
    const auto& correction = *results[i].correction;
    EXPECT_EQ(results[i].match.state, MatchState::kLocked);
    const auto& landmark = built.at(correction.landmark_id - 1);
    const double z_m = 0.5 + static_cast<double>(i);
    const auto truth = landmark.map_from_base.inverse() * base_at(moved(z_m, 0.02 * std::sin(z_m), 0.4));
    const auto error = vision::pose_error(correction.pose.landmark_from_base, truth);
    EXPECT_LT(error.head<3>().norm(), 0.15);  // a pixel is 0.06 m at 14 m
    EXPECT_LT(error.tail<3>().norm(), 0.01);
    EXPECT_LT(error.dot(correction.pose.covariance.ldlt().solve(error)), 40.0);
  }
}

TEST_F(StereoPlacesTest, WaitsForThreeSightingsThatAgree) {
  drive(Street(), 0.0, 9.0);
  way_m += 100.0;
  const auto results = drive(Street(), 0.0, 4.0);
  EXPECT_FALSE(results[0].correction || results[1].correction);
  EXPECT_NE(results[0].match.reason.find("waiting for confirmation"), std::string::npos) << results[0].match.reason;
  EXPECT_TRUE(results[2].correction.has_value()) << results[2].match.reason;
}

TEST_F(StereoPlacesTest, NeedsMoreWhileItsPositionIsUnknown) {
  drive(Street(), 0.0, 9.0);
  way_m += 100.0;
  is_located = false;
  drift = Eigen::Isometry3d(Eigen::Translation3d(500.0, 300.0, 0.0));
  const auto results = drive(Street(), 0.0, 8.0);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_FALSE(results[i].correction.has_value());
  EXPECT_TRUE(results[6].correction.has_value()) << results[6].match.reason;
  EXPECT_TRUE(results[7].correction.has_value());  // not thinned: the localizer waits for a second one
}

TEST_F(StereoPlacesTest, FindsNothingInAnotherStreet) {
  drive(Street(), 0.0, 9.0);
  way_m += 100.0;
  is_located = false;
  for (int seed = 1; seed <= 4; ++seed) EXPECT_EQ(corrections(drive(Street::of_seed(seed), 0.0, 9.0)), 0);
}

TEST_F(StereoPlacesTest, IsNotDeceivedByOneEqualWall) {
  drive(Street(), 0.0, 9.0);
  way_m += 100.0;
  auto other = Street::of_seed(3);
  other.seeds[1] = Street().seeds[1];
  for (const auto& result : drive(other, 0.0, 9.0)) {
    EXPECT_FALSE(result.correction.has_value());
    EXPECT_EQ(result.match.reason.find("waiting"), std::string::npos) << result.match.reason;
  }
}

TEST_F(StereoPlacesTest, DoesNotSearchWhatItHasJustBuilt) {
  drive(Street(), 0.0, 9.0);
  for (const auto& result : drive(Street(), 0.0, 9.0)) EXPECT_EQ(result.match.candidates, 0);
}

TEST_F(StereoPlacesTest, DoesNotSearchFarFromThePosition) {
  drive(Street(), 0.0, 9.0);
  way_m += 100.0;
  drift = Eigen::Isometry3d(Eigen::Translation3d(60.0, 0.0, 0.0));
  EXPECT_EQ(drive(Street(), 0.0, 0.0).at(0).match.candidates, 0);
  sigma_m = 20.0;
  EXPECT_GT(drive(Street(), 0.0, 0.0).at(0).match.candidates, 0);
}

TEST_F(StereoPlacesTest, ReportsThePassOfALandmarkWhenItEnds) {
  drive(Street(), 0.0, 9.0);
  way_m += 100.0;
  auto results = drive(Street(), 0.0, 9.0);
  way_m += 20.0;
  results.push_back(see(Street::of_seed(9), moved(0.0)));
  int passes = 0;
  for (const auto& result : results) {
    if (!result.passed) continue;
    ++passes;
    EXPECT_EQ(result.passed->state, MatchState::kMatched);
    EXPECT_LT(result.passed->stamp_ns, result.match.stamp_ns);
  }
  EXPECT_GE(passes, 2);
}

TEST_F(StereoPlacesTest, UsesNoBlackImage) {
  StereoView view;
  view.stamp_ns = 1;
  view.left = cv::Mat(240, 320, CV_8UC1, cv::Scalar(0));
  view.right = view.left;
  EXPECT_EQ(places.step(view).match.state, MatchState::kUnusable);
}

TEST_F(StereoPlacesTest, ComparesViewsByPathTurnAndTime) {
  see(Street(), moved(0.0));
  const auto base = base_at(moved(0.0));
  EXPECT_FALSE(places.is_due(stamp_ns + 1'000'000'000, base, way_m + 0.5));
  EXPECT_TRUE(places.is_due(stamp_ns + 1'000'000'000, base, way_m + 1.1));
  EXPECT_FALSE(places.is_due(stamp_ns + 300'000'000, base, way_m + 1.1));
  EXPECT_TRUE(places.is_due(stamp_ns + 1'000'000'000, base_at(moved(0.0, 0.2)), way_m));
}

TEST(ViewSettings, AreReadByTheToolsForLandmarksButNotComparedWithPanoramas) {
  const auto settings = view_settings({});
  const auto read = landmarks::from_settings<landmarks::DescriptionParameters>(settings);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->first, landmarks::DescriptionParameters{});
  EXPECT_FALSE(landmarks::differences(settings, landmarks::description_settings(read->first, read->second)).empty());
}

}  // namespace
}  // namespace panvo::stereo_places
