// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/landmark_distance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <opencv2/core/hal/intrin.hpp>
#include <vector>

#include "feature_spread.hpp"
#include "panvo/vision/equirectangular.hpp"
#include "panvo/vision/intensity_histogram.hpp"

namespace panvo::landmarks {
namespace {

constexpr float kTruncation =
    1.0F;  // spreads: larger differences mean an occluded or displaced patch and are truncated
constexpr float kMinMean = 0.01F;
constexpr int kMeanHeadings = 12;
constexpr double kMinimumReach_rad = 20.0 * std::numbers::pi / 180.0;  // of a minimum over the headings

float difference(float value, float landmark_value, float scale) {
  return std::min(1.0F, std::abs(value - landmark_value) / (kTruncation * std::max(kMinFeatureSpread, scale)));
}

/// [Lu2015 Eq. 11] of one feature at all headings: adds weight * min(1, |response - value| * factor) to the sums.
void add_differences(const float* responses, float value, float factor, float weight, std::vector<float>& sums) {
  const cv::v_float32x4 values = cv::v_setall_f32(value), factors = cv::v_setall_f32(factor);
  const cv::v_float32x4 weights = cv::v_setall_f32(weight), one = cv::v_setall_f32(1.0F);
  std::size_t i = 0;
  for (; i + 4 <= sums.size(); i += 4) {
    const cv::v_float32x4 difference = cv::v_min(one, cv::v_absdiff(cv::v_load(responses + i), values) * factors);
    cv::v_store(&sums[i], cv::v_load(&sums[i]) + weights * difference);
  }
  for (; i < sums.size(); ++i) sums[i] += weight * std::min(1.0F, std::abs(responses[i] - value) * factor);
}

float distance(const QueryDescription& query, const vision::MeasurementMatrix& matrix,
               const std::vector<AdaptiveFeature>& features, double heading_rad) {
  const int shift = static_cast<int>(std::lround(heading_rad * matrix.band().width / (2.0 * std::numbers::pi)));
  const vision::ResponseReader reader(query.images, matrix, query.normalisation);
  float sum = 0.0F, weights = 0.0F;
  for (const AdaptiveFeature& feature : features) {
    const bool is_intensity = feature.row < matrix.rows();
    const float value = is_intensity ? reader.read_intensity(feature.row, shift)
                                     : reader.read_gradient(feature.row - matrix.rows(), shift);
    sum += feature.weight * difference(value, feature.value, feature.scale);
    weights += feature.weight;
  }
  return weights > 0.0F ? sum / weights : 1.0F;
}

}  // namespace

float histogram_distance(const QueryDescription& query, const PanoramaDescription& landmark) {
  return vision::histogram_distance(query.histogram, landmark.histogram);
}

float large_scale_distance(const QueryDescription& query, const PanoramaDescription& landmark, double heading_rad) {
  return distance(query, query.basis->large, landmark.large, heading_rad);
}

float small_scale_distance(const QueryDescription& query, const PanoramaDescription& landmark, double heading_rad) {
  return distance(query, query.basis->small, landmark.small, heading_rad);
}

float mean_small_scale_distance(const QueryDescription& query, const PanoramaDescription& landmark) {
  float sum = 0.0F;
  for (int i = 0; i < kMeanHeadings; ++i) {
    sum += small_scale_distance(query, landmark, i * 2.0 * std::numbers::pi / kMeanHeadings);
  }
  return std::max(kMinMean, sum / kMeanHeadings);
}

HeadingMatch match_large_scale(const QueryDescription& query, const PanoramaDescription& landmark) {
  const auto headings = static_cast<std::size_t>(query.basis->parameters.headings);
  const double step_rad = 2.0 * std::numbers::pi / static_cast<double>(headings);
  std::vector<float> sums(headings, 0.0F);
  for (const AdaptiveFeature& feature : landmark.large) {
    const float* responses = &query.large_responses[feature.row * headings];
    const float factor = 1.0F / (kTruncation * std::max(kMinFeatureSpread, feature.scale));
    add_differences(responses, feature.value, factor, feature.weight, sums);
  }
  const float mean = std::accumulate(sums.begin(), sums.end(), 0.0F) / static_cast<float>(headings);
  if (mean <= 0.0F) return {};  // no features, or none that varies: no decision possible
  const auto best = static_cast<std::size_t>(std::min_element(sums.begin(), sums.end()) - sums.begin());
  const auto heading = [&](std::size_t i) {
    return vision::wrap(static_cast<double>(i) * step_rad, 2.0 * std::numbers::pi);
  };
  HeadingMatch match{heading(best), sums[best] / mean, 1.0F};
  for (std::size_t i = 0; i < headings; ++i) {
    const double apart = vision::wrap(heading(i) - match.heading_rad, 2.0 * std::numbers::pi);
    if (std::abs(apart) > kMinimumReach_rad) match.second_distance = std::min(match.second_distance, sums[i] / mean);
  }
  return match;
}

}  // namespace panvo::landmarks
