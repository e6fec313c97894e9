// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/landmark_matcher.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "panvo/vision/equirectangular.hpp"
#include "synthetic_place.hpp"

namespace panvo::position_corrector {
namespace {

constexpr std::int64_t kPeriod_ns = 200'000'000;

class LandmarkMatching : public testing::Test {
 protected:
  LandmarkMatching() {
    for (unsigned i = 0; i < 4; ++i) add(place(i + 1), Eigen::Vector3d(100.0 * i, 0.0, 0.0));
  }

  std::uint32_t add(const cv::Mat& panorama, const Eigen::Vector3d& position) {
    const auto id = library.add(landmark_of(panorama, describer, position));
    matcher.added(id);
    return id;
  }

  /// Adds the next panorama, one metre after the last.
  LandmarkMatch pass(const cv::Mat& panorama, std::optional<PositionPrior> prior = {}) {
    ++frames;
    return matcher.match({frames * kPeriod_ns, panorama, static_cast<double>(frames), prior}, library);
  }

  landmarks::KeypointParameters keypoints;
  landmarks::PanoramaDescriber describer{{}, 1};
  LandmarkMatcher matcher{{}, keypoints, describer};
  landmarks::LandmarkLibrary library;
  int frames = 0;
};

TEST_F(LandmarkMatching, FindsAPlaceAtAnyHeading) {
  for (const int columns : {0, 90, 333, 540, 777, 1000}) {
    LandmarkMatcher fresh({}, keypoints, describer);
    const auto match = fresh.match({kPeriod_ns, turned(place(3), columns), 0.0, std::nullopt}, library);
    ASSERT_EQ(match.state, MatchState::kLocked) << columns << ": " << match.reason;
    EXPECT_EQ(match.landmark_id, 3U);
    EXPECT_NEAR(std::remainder(match.heading_rad - 2.0 * M_PI * columns / kColumns, 2.0 * M_PI), 0.0, 0.005) << columns;
    ASSERT_TRUE(match.pose);
    EXPECT_LT(match.pose->landmark_from_panorama.translation().norm(), 0.1);
  }
}

TEST_F(LandmarkMatching, LeavesOutTheVehicle) {
  cv::Mat seen(54, 108, CV_8UC1, cv::Scalar(255));
  seen.colRange(54, 108).setTo(0);  // all to the right of the picture's middle
  matcher.set_seen(seen);
  const auto match = pass(place(3));
  ASSERT_EQ(match.state, MatchState::kLocked) << match.reason;
  EXPECT_FALSE(match.points.empty());
  for (const auto& point : match.points) EXPECT_LT(point.bearing.x(), 0.0);
}

TEST_F(LandmarkMatching, ComparesOnlyTheMostSimilarOnesOfMany) {
  MatchingParameters parameters;
  parameters.max_compared = 2;
  LandmarkMatcher exact({}, keypoints, describer), limited(parameters, keypoints, describer);
  const cv::Mat view = turned(place(3), 333);
  const auto match = limited.match({kPeriod_ns, view, 0.0, std::nullopt}, library);
  const auto expected = exact.match({kPeriod_ns, view, 0.0, std::nullopt}, library);
  ASSERT_EQ(match.state, MatchState::kLocked) << match.reason;
  EXPECT_EQ(match.landmark_id, 3U);
  EXPECT_EQ(match.large_distance, expected.large_distance);
  EXPECT_EQ(match.heading_rad, expected.heading_rad);
  EXPECT_EQ(match.candidates, 4);
  EXPECT_EQ(match.kept_after_histogram, 2);

  LandmarkMatcher near(parameters, keypoints, describer);  // three landmarks around a position
  const PositionPrior prior{{200.0, 0.0, 0.0}, 30.0};
  const auto nearby = near.match({kPeriod_ns, view, 0.0, prior}, library);
  EXPECT_EQ(nearby.landmark_id, 3U);
  EXPECT_EQ(nearby.candidates, 3);
  EXPECT_EQ(nearby.kept_after_histogram, 2);
}

TEST_F(LandmarkMatching, TellsThePlaceOnceItIsPastAndNamesTheMostSimilarPanorama) {
  EXPECT_NE(pass(place(50)).state, MatchState::kLocked);
  cv::Mat nearly = place(2);
  cv::rectangle(nearly, {100, 150, 120, 150}, 30, cv::FILLED);
  EXPECT_EQ(pass(nearly).state, MatchState::kLocked);
  const int nearest = frames + 1;
  EXPECT_EQ(pass(place(2)).state, MatchState::kLocked);
  LandmarkMatch match;
  for (int i = 0; i < 4 && match.state != MatchState::kMatched; ++i) match = pass(nearly);
  ASSERT_EQ(match.state, MatchState::kMatched);
  EXPECT_EQ(match.landmark_id, 2U);
  EXPECT_EQ(match.stamp_ns, nearest * kPeriod_ns);
  EXPECT_TRUE(match.reason.empty());
  EXPECT_TRUE(match.pose);
  // the pass has the distance of each panorama and the keypoints of the nearest one
  ASSERT_TRUE(match.pass);
  ASSERT_EQ(match.pass->curve.size(), static_cast<std::size_t>(frames - nearest + 2));
  EXPECT_LT(match.pass->curve[1].distance, match.pass->curve[0].distance);
  EXPECT_LT(match.pass->curve[1].distance, match.pass->curve[2].distance);
  EXPECT_DOUBLE_EQ(match.pass->curve[1].travelled_m, nearest);
  EXPECT_EQ(match.pass->keypoints, detect_keypoints(place(2), keypoints));
}

/// Standing still, as the time then ends a pass.
class ALockWhileTheClockIsSetBack : public LandmarkMatching {
 protected:
  ALockWhileTheClockIsSetBack() {
    frames = 3000;
    for (int i = 0; i < 5; ++i) EXPECT_EQ(stand().state, MatchState::kLocked);
  }

  LandmarkMatch stand() {
    ++frames;
    return matcher.match({frames * kPeriod_ns, place(2), 10.0, std::nullopt}, library);
  }
};

TEST_F(ALockWhileTheClockIsSetBack, IsReplacedByOneWithTheNewTime) {
  const int before = frames;
  frames -= 2000;
  const int first = frames + 5;  // by then it is certain
  LandmarkMatch match;
  for (int i = 0; i < 40 && match.state != MatchState::kMatched; ++i) match = stand();
  ASSERT_EQ(match.state, MatchState::kMatched) << "it would take all of these minutes";
  EXPECT_EQ(match.landmark_id, 2U);
  EXPECT_GE(match.stamp_ns, first * kPeriod_ns);
  EXPECT_LT(match.stamp_ns, before * kPeriod_ns);
  ASSERT_TRUE(match.pass);
  EXPECT_EQ(match.pass->curve.size(), static_cast<std::size_t>(frames - first + 1));
}

TEST_F(ALockWhileTheClockIsSetBack, SurvivesASingleLatePanorama) {
  const int before = frames;
  frames -= 2000;
  EXPECT_EQ(stand().state, MatchState::kLocked);
  frames = before;
  LandmarkMatch match;
  for (int i = 0; i < 40 && match.state != MatchState::kMatched; ++i) match = stand();
  ASSERT_EQ(match.state, MatchState::kMatched);
  ASSERT_TRUE(match.pass);
  EXPECT_EQ(match.pass->curve.size(), static_cast<std::size_t>(frames - 3000 + 1)) << "of all panoramas";
}

/// The view `ahead_m` in front of the landmark, whose points are all 20 m away.
cv::Mat seen_from(const cv::Mat& panorama, double ahead_m) {
  const vision::Equirectangular sphere{panorama.cols, panorama.rows};
  const Eigen::Vector3d position(0.0, 0.0, ahead_m);
  cv::Mat u(panorama.size(), CV_32FC1), v(panorama.size(), CV_32FC1), view;
  for (int row = 0; row < panorama.rows; ++row) {
    for (int column = 0; column < panorama.cols; ++column) {
      const Eigen::Vector3d bearing = sphere.unproject(Eigen::Vector2d(column, row));
      const double along = position.dot(bearing);
      const double range = std::sqrt(along * along + 400.0 - position.squaredNorm()) - along;
      const Eigen::Vector2d pixel = sphere.project(position + range * bearing);
      u.at<float>(row, column) = static_cast<float>(pixel.x());
      v.at<float>(row, column) = static_cast<float>(pixel.y());
    }
  }
  cv::remap(panorama, view, u, v, cv::INTER_LINEAR, cv::BORDER_WRAP);
  return view;
}

TEST_F(LandmarkMatching, GoesOnWhileThePosesComeNearerThoughTheViewIsLessSimilar) {
  EXPECT_EQ(pass(seen_from(place(2), -1.0)).state, MatchState::kLocked);
  for (const double ahead_m : {-0.8, -0.6, -0.4, -0.2}) {
    cv::Mat half_hidden = seen_from(place(2), ahead_m);
    place(50).colRange(0, 500).copyTo(half_hidden.colRange(0, 500));
    const auto match = pass(half_hidden);
    ASSERT_EQ(match.state, MatchState::kLocked) << ahead_m;
    ASSERT_TRUE(match.pose) << ahead_m << ": " << match.reason;
  }
  const int nearest = frames + 1;
  EXPECT_EQ(pass(place(2)).state, MatchState::kLocked);
  LandmarkMatch match;
  for (int i = 1; i < 5 && match.state != MatchState::kMatched; ++i) match = pass(seen_from(place(2), i));
  ASSERT_EQ(match.state, MatchState::kMatched);
  EXPECT_EQ(match.stamp_ns, nearest * kPeriod_ns);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_GT(match.pass->curve[i].distance, match.pass->curve[0].distance);
}

TEST_F(LandmarkMatching, KnowsNoPlaceThatIsNotInTheLibrary) {
  for (unsigned seed = 100; seed < 106; ++seed) {
    const auto match = pass(place(seed));
    EXPECT_TRUE(match.state == MatchState::kSearching || match.state == MatchState::kRejected) << seed;
    EXPECT_FALSE(match.reason.empty());
    EXPECT_EQ(match.candidates, 4);
  }
}

TEST_F(LandmarkMatching, LooksOnlyNearThePositionWhereThereIsOne) {
  const PositionPrior far{Eigen::Vector3d(250.0, 0.0, 0.0), 1.0};
  const auto none = pass(place(2), far);
  EXPECT_EQ(none.candidates, 0);
  EXPECT_EQ(none.reason, "no landmark near the position");
  const PositionPrior unsure{Eigen::Vector3d(250.0, 0.0, 0.0), 45.0};
  const auto match = pass(place(2), unsure);
  EXPECT_EQ(match.state, MatchState::kLocked) << match.reason;
  EXPECT_EQ(match.landmark_id, 2U);
}

TEST_F(LandmarkMatching, DoesNotTakeForARevisitWhatWasBuiltAMomentAgo) {
  pass(place(60));
  const auto id = add(place(61), Eigen::Vector3d::Zero());
  EXPECT_EQ(pass(place(61)).candidates, 4);
  frames += 40;
  const auto match = pass(place(61));
  EXPECT_EQ(match.state, MatchState::kLocked) << match.reason;
  EXPECT_EQ(match.landmark_id, id);
}

TEST_F(LandmarkMatching, RejectsTheSamePictureWhoseGeometryIsAnother) {
  // with wrong depths no pose agrees, however similar the images
  landmarks::LandmarkLibrary wrong;
  landmarks::PanoramicLandmark landmark;
  landmark.description = describer.describe(place(7));
  landmark.keypoints = detect_keypoints(place(7), keypoints);
  std::mt19937_64 random(1);
  for (auto& keypoint : landmark.keypoints) {
    keypoint.has_point = true;
    const double azimuth = static_cast<double>(random() % 6283) / 1000.0;
    keypoint.point_in_panorama = Eigen::Vector3d(20.0 * std::sin(azimuth), 1.0, 20.0 * std::cos(azimuth)).cast<float>();
    keypoint.inverse_range_sigma = 0.001F;
  }
  wrong.add(landmark);
  const auto match = matcher.match({kPeriod_ns, place(7), 0.0, std::nullopt}, wrong);
  EXPECT_EQ(match.state, MatchState::kRejected);
  EXPECT_EQ(match.landmark_id, 1U);
  EXPECT_NE(match.reason.find("landmark 1: "), std::string::npos) << match.reason;
}

TEST_F(LandmarkMatching, SaysWhyAPanoramaIsOfNoUse) {
  const auto match = pass(cv::Mat(kRows, kColumns, CV_8UC1, cv::Scalar(0)));
  EXPECT_EQ(match.state, MatchState::kUnusable);
  EXPECT_NE(match.reason.find("black"), std::string::npos) << match.reason;
}

TEST_F(LandmarkMatching, HasNothingToSayWithoutLandmarks) {
  const auto match = matcher.match({kPeriod_ns, place(1), 0.0, std::nullopt}, landmarks::LandmarkLibrary());
  EXPECT_EQ(match.state, MatchState::kSearching);
  EXPECT_EQ(match.reason, "no landmarks yet");
}

}  // namespace
}  // namespace panvo::position_corrector
