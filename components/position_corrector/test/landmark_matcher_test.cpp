// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/landmark_matcher.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

namespace panvo::position_corrector {
namespace {

constexpr int kColumns = 1080;
constexpr int kRows = 540;
constexpr std::int64_t kPeriod_ns = 200'000'000;

/// A panorama of nothing in particular, unlike that of any other seed, without a seam.
cv::Mat place(unsigned seed) {
  std::mt19937_64 random(seed);
  cv::Mat panorama(kRows, kColumns, CV_8UC1, cv::Scalar(110));
  for (int i = 0; i < 900; ++i) {
    const int width = 4 + static_cast<int>(random() % 50);
    const int height = 4 + static_cast<int>(random() % 40);
    const cv::Rect box(static_cast<int>(random() % kColumns), 120 + static_cast<int>(random() % 220), width, height);
    const cv::Scalar grey(static_cast<double>(20 + random() % 210));
    cv::rectangle(panorama, box, grey, cv::FILLED);
    cv::rectangle(panorama, box - cv::Point(kColumns, 0), grey, cv::FILLED);
  }
  return panorama;
}

/// As a vehicle turned to the left sees it: everything farther to the right.
cv::Mat turned(const cv::Mat& panorama, int columns) {
  cv::Mat result(panorama.size(), panorama.type());
  for (int u = 0; u < kColumns; ++u) panorama.col(u).copyTo(result.col((u + columns) % kColumns));
  return result;
}

class LandmarkMatching : public testing::Test {
 protected:
  LandmarkMatching() {
    for (unsigned i = 0; i < 4; ++i) add(place(i + 1), Eigen::Vector3d(100.0 * i, 0.0, 0.0));
  }

  std::uint32_t add(const cv::Mat& panorama, const Eigen::Vector3d& position) {
    landmarks::PanoramicLandmark landmark;
    landmark.map_from_base.translation() = position;
    landmark.description = describer.describe(panorama);
    landmark.keypoints = detect_keypoints(panorama, keypoints);
    for (auto& keypoint : landmark.keypoints) {  // all 20 m away
      keypoint.has_point = true;
      keypoint.point_in_panorama = 20.0F * keypoint.bearing;
      keypoint.inverse_range_sigma = 0.001F;
    }
    const auto id = library.add(landmark);
    matcher.added(id);
    return id;
  }

  /// The next panorama on the way, a metre after the last.
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
  EXPECT_EQ(none.reason, "no landmark within reach of the position");
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
  // where everything is elsewhere in depth no pose agrees, however alike the pictures
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
