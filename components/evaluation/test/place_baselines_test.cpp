// SPDX-License-Identifier: Apache-2.0
/// Baseline methods on synthetic panoramas.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>
#include <stdexcept>

#include "brief_pattern.hpp"
#include "panvo/evaluation/brief_gist.hpp"
#include "panvo/evaluation/cyclic_brief_gist.hpp"
#include "panvo/evaluation/fourier_signature.hpp"
#include "panvo/evaluation/histogram_places.hpp"

namespace panvo::evaluation {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Grey blocks of random sizes; `place` is the seed.
cv::Mat made_up_panorama(std::uint64_t place) {
  std::mt19937_64 random(place);
  const auto below = [&](int limit) { return static_cast<int>(random() % static_cast<std::uint64_t>(limit)); };
  cv::Mat panorama(540, 1080, CV_8UC1, cv::Scalar(60 + below(100)));
  for (int i = 0; i < 120; ++i) {
    const cv::Rect block(below(1080), 120 + below(200), 10 + below(120), 10 + below(80));
    for (const int shift : {0, -1080}) {  // across the seam
      cv::rectangle(panorama, block + cv::Point(shift, 0), cv::Scalar(20 + below(200)), cv::FILLED);
      if (shift == 0 && block.x + block.width <= 1080) break;
    }
  }
  cv::GaussianBlur(panorama, panorama, {5, 5}, 1.5, 1.5, cv::BORDER_REFLECT);
  return panorama;
}

/// The view after a left turn of the vehicle: the scene moves to the right.
cv::Mat turned_left(const cv::Mat& panorama, int columns) {
  const int shift = ((columns % panorama.cols) + panorama.cols) % panorama.cols;
  cv::Mat turned;
  if (shift == 0) return panorama.clone();
  cv::hconcat(panorama.colRange(panorama.cols - shift, panorama.cols), panorama.colRange(0, panorama.cols - shift),
              turned);
  return turned;
}

cv::Mat darker(const cv::Mat& panorama) {
  cv::Mat dark;
  panorama.convertTo(dark, CV_8U, 0.6, 10.0);
  return dark;
}

struct Case {
  const char* name;
  std::function<std::unique_ptr<PlaceMethod>()> make;
  bool knows_heading;
  double heading_tolerance_deg;
  double dark_distance;  // distance to the same panorama, darker

  friend std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }
};

class Baseline : public testing::TestWithParam<Case> {
 protected:
  PlaceDistance compare(const cv::Mat& query, const cv::Mat& landmark) const {
    return method_->distance(*method_->describe_query(query), *method_->describe_landmark(landmark));
  }
  std::unique_ptr<PlaceMethod> method_ = GetParam().make();
};

TEST_P(Baseline, FindsNoDifferenceBetweenAPanoramaAndItself) {
  const auto panorama = made_up_panorama(1);
  const auto found = compare(panorama, panorama);
  EXPECT_NEAR(found.distance, 0.0, 1e-12);
  EXPECT_NEAR(found.heading_rad, 0.0, 1e-9);
}

TEST_P(Baseline, TellsPlacesApart) {
  double nearest = 1.0;
  for (std::uint64_t other = 2; other < 12; ++other) {
    nearest = std::min(nearest, compare(made_up_panorama(1), made_up_panorama(other)).distance);
  }
  EXPECT_GT(nearest, compare(darker(made_up_panorama(1)), made_up_panorama(1)).distance + 0.01);
}

TEST_P(Baseline, CaresLittleForLessLight) {
  EXPECT_LT(compare(darker(made_up_panorama(3)), made_up_panorama(3)).distance, GetParam().dark_distance);
}

TEST_P(Baseline, FindsATurnedPanoramaAndHowItIsTurned) {
  if (!GetParam().knows_heading) GTEST_SKIP() << "the method estimates no heading";
  const auto panorama = made_up_panorama(5);
  for (const int degrees : {10, 37, 90, 144, 180, -3, -90, -151}) {
    const auto found = compare(turned_left(panorama, degrees * 3), panorama);
    const double error = std::remainder(found.heading_rad - degrees * kDegree, 360.0 * kDegree);
    EXPECT_NEAR(error / kDegree, 0.0, GetParam().heading_tolerance_deg) << degrees;
    EXPECT_LT(found.distance, compare(turned_left(panorama, degrees * 3), made_up_panorama(6)).distance);
  }
}

TEST_P(Baseline, GivesTheSameResultTwice) {
  const auto other = GetParam().make();
  const auto a = made_up_panorama(7), b = made_up_panorama(8);
  const auto first = compare(a, b);
  const auto second = other->distance(*other->describe_query(a), *other->describe_landmark(b));
  EXPECT_EQ(first.distance, second.distance);
  EXPECT_EQ(first.heading_rad, second.heading_rad);
}

TEST_P(Baseline, StandsOrRefusesAPanoramaWithoutAnything) {
  try {
    const auto found = compare(made_up_panorama(1), cv::Mat(540, 1080, CV_8UC1, cv::Scalar(0)));
    EXPECT_TRUE(std::isfinite(found.distance) && std::isfinite(found.heading_rad));
  } catch (const std::invalid_argument& refused) {
    EXPECT_STRNE(refused.what(), "");
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, Baseline,
    testing::Values(Case{"brief_gist", [] { return brief_gist(1); }, false, 0.0, 0.03},
                    Case{"cyclic_brief_gist", [] { return cyclic_brief_gist(1); }, true, 2.5, 0.03},
                    Case{"histogram", [] { return histogram_places({}); }, false, 0.0, 0.03},
                    Case{"fourier_signature", [] { return fourier_signature(); }, true, 0.2, 0.03}),
    [](const auto& baseline) { return baseline.param.name; });

TEST(BriefGist, KnowsNothingOfHeadings) {
  const auto method = brief_gist(1);
  const auto panorama = made_up_panorama(5);
  const auto turned = method->describe_query(turned_left(panorama, 270));
  const auto found = method->distance(*turned, *method->describe_landmark(panorama));
  EXPECT_EQ(found.heading_rad, 0.0);
  EXPECT_GT(found.distance, 0.3) << "rotated by 90 degrees, the image differs";
}

TEST(IntensityHistogram, IsTheSameAtEveryHeading) {
  const auto method = histogram_places({});
  const auto panorama = made_up_panorama(5);
  const auto turned = method->describe_query(turned_left(panorama, 411));
  const auto same = method->distance(*turned, *method->describe_landmark(panorama));
  const auto other = method->distance(*turned, *method->describe_landmark(made_up_panorama(6)));
  EXPECT_LT(same.distance, 0.02);
  EXPECT_LT(same.distance, 0.3 * other.distance);
}

TEST(BriefPattern, ComparesPixelPairs) {
  const BriefPattern pattern(1);
  cv::Mat ramp(60, 120, CV_8UC1);
  for (int x = 0; x < ramp.cols; ++x) ramp.col(x).setTo(x);
  cv::Mat reversed;
  cv::flip(ramp, reversed, 1);
  const auto rising = pattern.describe(ramp, 10), falling = pattern.describe(reversed, 10);
  EXPECT_EQ(rising, pattern.describe(ramp, 30)) << "only differences count";
  // Pairs within one column are equal in both.
  EXPECT_GT(hamming_distance(rising, falling), 235);
  EXPECT_NE(rising, BriefPattern(2).describe(ramp, 10));
  EXPECT_EQ(hamming_distance(rising, rising), 0);
}

}  // namespace
}  // namespace panvo::evaluation
