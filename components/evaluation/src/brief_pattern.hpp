// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace panvo::evaluation {

/// BRIEF of a square patch: 256 comparisons of two smoothed pixels each, sampled around the centre from an isotropic
/// Gaussian of variance S^2/25 (Calonder et al. 2010).
class BriefPattern {
 public:
  static constexpr int kPatch_px = 60;  ///< S
  static constexpr int kBits = 256;
  using Bits = std::array<std::uint64_t, kBits / 64>;

  /// The comparisons depend only on the seed, not on the machine.
  explicit BriefPattern(std::uint64_t seed);

  /// Describes the patch that starts at column `left` of a smoothed image with kPatch_px rows (CV_8UC1); columns wrap
  /// around.
  Bits describe(const cv::Mat& smoothed, int left) const;

 private:
  struct Comparison {
    cv::Point first, second;
  };
  std::vector<Comparison> comparisons_;
};

/// Number of differing bits.
int hamming_distance(const BriefPattern::Bits& a, const BriefPattern::Bits& b);

/// The band of a panorama (CV_8UC1, 1080x540) used by all methods, from 35 degrees above the horizon to 15 below.
cv::Mat described_band(const cv::Mat& panorama);

/// The band scaled to kPatch_px rows and `columns` columns, smoothed for BRIEF, also across the seam.
cv::Mat smoothed_band(const cv::Mat& panorama, int columns);

}  // namespace panvo::evaluation
