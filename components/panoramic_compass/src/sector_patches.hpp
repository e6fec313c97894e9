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

/// How far a band moved, roughly.
struct SectorShifts {
  static constexpr int kSectors = 8;

  double turn_px = 0.0;                      ///< all sectors together
  std::array<double, kSectors> sector_px{};  ///< each by itself, near the common one: its parallax included
  bool beyond_range = false;                 ///< the smallest distance lies at the border of the search
  std::string reason;                        ///< why the common one is not clear; empty when it is
};

/// Patches all round a band, each a sector of it, described by adaptive compressive features: by how many columns a band moved
/// against the last, from the sum of their distances.
class SectorPatches {
 public:
  SectorPatches(cv::Size band, const PatchParameters& parameters, std::uint64_t seed);

  FeatureBand prepare(const cv::Mat& band) const { return {band, widest_}; }
  void describe(const FeatureBand& band);

  /// Searches `range_px` to either side of `expected_px`, px to the right.
  SectorShifts track(const FeatureBand& band, double expected_px, int range_px, double largest_distance) const;

 private:
  cv::Size band_;
  std::vector<FeaturePatch> patches_;
  int widest_ = 0;
};

}  // namespace panvo::panoramic_compass
