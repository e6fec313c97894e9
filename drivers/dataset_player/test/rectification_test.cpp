// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/rectification.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numeric>
#include <opencv2/features2d.hpp>

#include "panvo/dataset_player/dataset.hpp"
#include "panvo/dataset_player/image_file.hpp"
#include "panvo/test/recorded_data.hpp"

namespace panvo::dataset_player {
namespace {

/// Absolute row differences of matched features between the two images, px.
std::vector<double> row_errors_px(const cv::Mat& left, const cv::Mat& right) {
  const auto orb = cv::ORB::create(800, 1.2F, 4);
  std::vector<cv::KeyPoint> left_keypoints, right_keypoints;
  cv::Mat left_descriptors, right_descriptors;
  orb->detectAndCompute(left, {}, left_keypoints, left_descriptors);
  orb->detectAndCompute(right, {}, right_keypoints, right_descriptors);
  std::vector<cv::DMatch> matches;
  cv::BFMatcher(cv::NORM_HAMMING, true).match(left_descriptors, right_descriptors, matches);
  std::vector<double> errors;
  for (const auto& match : matches) {
    const auto& a = left_keypoints[static_cast<std::size_t>(match.queryIdx)].pt;
    const auto& b = right_keypoints[static_cast<std::size_t>(match.trainIdx)].pt;
    // Larger differences are mismatches; the gate is wide enough not to favour either image pair.
    if (match.distance < 40 && std::abs(a.y - b.y) < 10 && a.x - b.x > -10 && a.x - b.x < 80)
      errors.push_back(std::abs(a.y - b.y));
  }
  return errors;
}

// Features lie on integer pixels of a pyramid level, so the mean is more informative than the median.
double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(RectificationOfARealPair, BringsMatchingFeaturesToOneRow) {
  for (const char* name : {"boofcv_stereo/library", "boofcv_stereo/backyard"}) {
    const auto path = panvo::test::recorded_data(name);
    PANVO_NEEDS_RECORDING(path);
    const auto dataset = open_dataset(path);
    const auto& stereo = *dataset.stereo;
    const auto& rectified = stereo.rectified;
    const vision::RectificationMap left_map(stereo.calibration.left, rectified.rectified_left_from_left,
                                            rectified.camera);
    const vision::RectificationMap right_map(stereo.calibration.right, rectified.rectified_right_from_right,
                                             rectified.camera);
    std::vector<double> raw, corrected;
    ImageDecoder decoder;
    for (std::size_t i = 0; i < stereo.frames.size(); i += 20) {
      cv::Mat left, right, left_rectified, right_rectified;
      ASSERT_EQ(decoder.decode(stereo.frames[i].left, Colour::kGrey, left), std::nullopt);
      ASSERT_EQ(decoder.decode(stereo.frames[i].right, Colour::kGrey, right), std::nullopt);
      left_map.apply(left, left_rectified);
      right_map.apply(right, right_rectified);
      for (const double error : row_errors_px(left, right)) raw.push_back(error);
      for (const double error : row_errors_px(left_rectified, right_rectified)) corrected.push_back(error);
    }
    ASSERT_GT(raw.size(), 200u);
    ASSERT_GT(corrected.size(), 200u);
    std::printf("%s: mean row error of matches %.2f px raw (%zu), %.2f px rectified (%zu)\n", name, mean(raw),
                raw.size(), mean(corrected), corrected.size());
    EXPECT_LT(mean(corrected), 0.6) << name;
    EXPECT_LT(mean(corrected), 0.4 * mean(raw)) << name;
  }
}

}  // namespace
}  // namespace panvo::dataset_player
