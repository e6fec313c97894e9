// SPDX-License-Identifier: Apache-2.0
// 77 real panoramas of a campus, each used as landmark and, disturbed, as query. A shifted image is easier to recognise
// than a real revisit, as there is no parallax: this tests robustness to heading, exposure, noise and occlusion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "panvo/landmarks/heading_search.hpp"
#include "panvo/landmarks/landmark_distance.hpp"
#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/test/recorded_data.hpp"
#include "panvo/vision/equirectangular.hpp"

namespace panvo::landmarks {
namespace {

namespace fs = std::filesystem;

std::vector<cv::Mat> load_panoramas(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<cv::Mat> panoramas;
  for (const fs::path& file : files) {
    cv::Mat image = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
    if (!image.empty()) panoramas.push_back(std::move(image));
  }
  return panoramas;
}

struct Disturbed {
  cv::Mat image;
  double heading_rad;
};

/// Panorama of a vehicle turned left, darker, with noise and three occlusions.
Disturbed disturb(const cv::Mat& panorama, cv::RNG& random) {
  const int shift = random.uniform(0, panorama.cols);
  cv::Mat image(panorama.size(), CV_8UC1);
  for (int u = 0; u < panorama.cols; ++u) panorama.col(u).copyTo(image.col((u + shift) % panorama.cols));
  cv::Mat noise(image.size(), CV_16S), darker;
  image.convertTo(darker, CV_16S, 0.6);
  random.fill(noise, cv::RNG::NORMAL, 0.0, 3.0);
  darker += noise;
  darker.convertTo(image, CV_8U);
  for (int i = 0; i < 3; ++i) {
    const cv::Rect patch{random.uniform(0, 980), random.uniform(170, 230), random.uniform(60, 100),
                         random.uniform(60, 120)};
    cv::rectangle(image, patch, cv::Scalar(random.uniform(0, 256)), cv::FILLED);
  }
  return {image, vision::wrap(2.0 * std::numbers::pi * shift / panorama.cols, 2.0 * std::numbers::pi)};
}

TEST(RecordedPanoramas, EachIsFoundAmongAllAtAnyHeadingWhateverLightNoiseAndCover) {
  const fs::path folder = panvo::test::recorded_data("panoramas");
  PANVO_NEEDS_RECORDING(folder);
  const PanoramaDescriber describer({}, 1);
  const std::vector<cv::Mat> panoramas = load_panoramas(folder);
  std::vector<PanoramaDescription> landmarks;
  for (const cv::Mat& panorama : panoramas) landmarks.push_back(describer.describe(panorama));

  cv::RNG random(20);
  int found = 0;
  double worst_deg = 0.0;
  float max_right = 0.0F, nearest_wrong = 1.0F;
  double sum_right = 0.0, sum_wrong = 0.0;
  for (std::size_t i = 0; i < panoramas.size(); ++i) {
    const Disturbed disturbed = disturb(panoramas[i], random);
    const QueryDescription query = describer.query(disturbed.image);
    std::vector<float> distances;
    for (const PanoramaDescription& landmark : landmarks) {
      distances.push_back(match_large_scale(query, landmark).distance);
    }
    const auto best =
        static_cast<std::size_t>(std::min_element(distances.begin(), distances.end()) - distances.begin());
    found += best == i ? 1 : 0;
    const HeadingMatch match = search_heading(query, landmarks[i], match_large_scale(query, landmarks[i]).heading_rad);
    const double error = vision::wrap(match.heading_rad - disturbed.heading_rad, 2.0 * std::numbers::pi);
    worst_deg = std::max(worst_deg, std::abs(error) * 180.0 / std::numbers::pi);
    max_right = std::max(max_right, distances[i]);
    sum_right += distances[i];
    for (std::size_t j = 0; j < distances.size(); ++j) {
      if (j == i) continue;
      nearest_wrong = std::min(nearest_wrong, distances[j]);
      sum_wrong += distances[j] / static_cast<double>(distances.size() - 1);
    }
  }
  const auto count = static_cast<double>(panoramas.size());
  std::cout << panoramas.size() << " places: recall@1 " << found / count << ", heading error at most " << worst_deg
            << " deg; large-scale D of the right one " << sum_right / count << " on average, at most " << max_right
            << ", of wrong ones " << sum_wrong / count << ", at least " << nearest_wrong << "\n";
  EXPECT_GE(found, 0.99 * count);
  EXPECT_LT(worst_deg, 3.0);
}

}  // namespace
}  // namespace panvo::landmarks
