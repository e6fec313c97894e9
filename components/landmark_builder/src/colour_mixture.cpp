// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/colour_mixture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace panvo::landmark_builder {
namespace {

constexpr float kExplained = 12.0F;    // squared Mahalanobis distance, three degrees of freedom: 99 %
constexpr float kWideVariance = 4.0F;  // of a new Gaussian, in multiples of the smallest variance

float squared_distance(const ColourMixture::Gaussian& gaussian, const GroundColour& colour) {
  float sum = 0.0F;
  for (std::size_t i = 0; i < colour.size(); ++i) {
    const float difference = colour[i] - gaussian.mean[i];
    sum += difference * difference / gaussian.variance[i];
  }
  return sum;
}

}  // namespace

ColourMixture::ColourMixture(int gaussians, GroundColour min_variance)
    : most_(static_cast<std::size_t>(gaussians)), min_variance_(min_variance) {}

void ColourMixture::learn(std::span<const GroundColour> samples, double rate) {
  if (samples.empty()) return;
  const double step = rate / static_cast<double>(samples.size());
  for (const GroundColour& sample : samples) {
    auto best = gaussians_.end();
    float best_distance = kExplained;
    for (auto gaussian = gaussians_.begin(); gaussian != gaussians_.end(); ++gaussian) {
      const float distance = squared_distance(*gaussian, sample);
      if (distance < best_distance) {
        best_distance = distance;
        best = gaussian;
      }
    }
    if (best == gaussians_.end()) {
      if (gaussians_.size() == most_) {
        gaussians_.erase(std::min_element(gaussians_.begin(), gaussians_.end(),
                                          [](const auto& a, const auto& b) { return a.weight < b.weight; }));
      }
      Gaussian added{sample, {}, 0.0};
      for (std::size_t i = 0; i < sample.size(); ++i) added.variance[i] = kWideVariance * min_variance_[i];
      gaussians_.push_back(added);
      best = std::prev(gaussians_.end());
    }
    for (auto& gaussian : gaussians_) gaussian.weight *= 1.0 - step;
    best->weight += step;
    // a Gaussian with few samples follows them faster
    const auto share = static_cast<float>(std::min(1.0, step / std::max(best->weight, step)));
    for (std::size_t i = 0; i < sample.size(); ++i) {
      const float difference = sample[i] - best->mean[i];
      best->mean[i] += share * difference;
      best->variance[i] =
          std::max(min_variance_[i], best->variance[i] + share * (difference * difference - best->variance[i]));
    }
  }
  std::stable_sort(gaussians_.begin(), gaussians_.end(),
                   [](const auto& a, const auto& b) { return a.weight > b.weight; });
}

void ColourMixture::log_density(const std::array<const float*, 3>& planes, int count, double min_weight,
                                float* out) const {
  std::fill(out, out + count, std::numeric_limits<float>::lowest());
  double sum = 0.0;
  for (const auto& gaussian : gaussians_) sum += gaussian.weight;
  for (const auto& gaussian : gaussians_) {
    if (gaussian.weight < min_weight * sum) continue;
    const auto constant = static_cast<float>(
        std::log(gaussian.weight / sum) -
        0.5 * std::log(static_cast<double>(gaussian.variance[0]) * gaussian.variance[1] * gaussian.variance[2]));
    const float m0 = gaussian.mean[0], m1 = gaussian.mean[1], m2 = gaussian.mean[2];
    const float s0 = 0.5F / gaussian.variance[0], s1 = 0.5F / gaussian.variance[1], s2 = 0.5F / gaussian.variance[2];
    const float *p0 = planes[0], *p1 = planes[1], *p2 = planes[2];
    for (int i = 0; i < count; ++i) {
      const float d0 = p0[i] - m0, d1 = p1[i] - m1, d2 = p2[i] - m2;
      const float value = constant - (d0 * d0 * s0 + d1 * d1 * s1 + d2 * d2 * s2);
      out[i] = value > out[i] ? value : out[i];
    }
  }
}

}  // namespace panvo::landmark_builder
