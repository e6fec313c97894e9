// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace panvo::panorama_stitcher {

struct GainSettings {
  double rate = 0.05;  ///< share of the way to the gains that a panorama asks for, each panorama
  double limit = 2.0;  ///< gains stay from 1 / limit to limit
};

/// Gains by which heads of different exposure show the same brightness where they overlap: least squares over all pairs of heads, their
/// logarithms zero on average. Slow and bounded, so that the panorama does not flicker; the same for the same images.
class GainCompensator {
 public:
  GainCompensator(std::size_t heads, const GainSettings& settings) : settings_(settings), log_gains_(heads, 0.0) {}

  /// What two heads show of the same places.
  struct Overlap {
    std::size_t first = 0, second = 0;
    double first_sum = 0.0, second_sum = 0.0;  ///< grey levels
    std::int64_t samples = 0;
  };
  void update(const std::vector<Overlap>& overlaps);

  double gain(std::size_t head) const;

 private:
  GainSettings settings_;
  std::vector<double> log_gains_;
};

}  // namespace panvo::panorama_stitcher
