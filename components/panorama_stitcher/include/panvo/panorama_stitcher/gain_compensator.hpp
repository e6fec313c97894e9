// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace panvo::panorama_stitcher {

struct GainSettings {
  double rate = 0.05;  ///< fraction of the difference to the target (log) gain applied with each panorama
  double limit = 2.0;  ///< gains are limited to [1 / limit, limit]
};

/// Estimates gains that equalise the brightness of the heads where they overlap: least squares over all pairs of heads,
/// with a mean log gain of zero. Smoothed and bounded to avoid flicker; deterministic.
class GainCompensator {
 public:
  GainCompensator(std::size_t heads, const GainSettings& settings) : settings_(settings), log_gains_(heads, 0.0) {}

  /// Brightness of two heads at common directions.
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
