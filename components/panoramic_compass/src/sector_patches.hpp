// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "panvo/panoramic_compass/compass_parameters.hpp"
#include "panvo/panoramic_compass/feature_patch.hpp"

namespace panvo::panoramic_compass {

/// Approximate shift of a band.
struct SectorShifts {
  static constexpr int kSectors = 8;

  double turn_px = 0.0;                      ///< common shift of all sectors
  std::array<double, kSectors> sector_px{};  ///< shift of each sector near the common one, including its parallax
  bool beyond_range = false;                 ///< the minimum lies at the end of the search range
  std::string reason;                        ///< why the common shift is ambiguous; empty if it is clear
};

/// One patch per sector of a band, described by adaptive compressive features. Estimates the shift of a band relative
/// to the last one from the sum of the patch distances.
class SectorPatches {
 public:
  SectorPatches(cv::Size band, const PatchParameters& parameters, std::uint64_t seed);

  FeatureBand prepare(const cv::Mat& band) const { return {band, widest_}; }
  void describe(const FeatureBand& band);

  /// Searches `range_px` on each side of `expected_px`; positive shifts are to the right.
  SectorShifts track(const FeatureBand& band, double expected_px, int range_px, double max_distance) const;

 private:
  cv::Size band_;
  std::vector<FeaturePatch> patches_;
  int widest_ = 0;
};

}  // namespace panvo::panoramic_compass
