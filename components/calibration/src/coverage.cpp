// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/coverage.hpp"

#include <algorithm>

namespace panvo::calibration {

Coverage coverage(const Observations& observations, std::size_t camera) {
  Coverage result;
  const auto& size = observations.image_sizes[camera];
  for (const auto& view : observations.views) {
    for (const auto& corner : view.seen[camera]) {
      const int column =
          std::clamp(static_cast<int>(Coverage::kColumns * corner.pixel.x() / size.width), 0, Coverage::kColumns - 1);
      const int row =
          std::clamp(static_cast<int>(Coverage::kRows * corner.pixel.y() / size.height), 0, Coverage::kRows - 1);
      ++result.corners.at(static_cast<std::size_t>(row * Coverage::kColumns + column));
    }
  }
  const auto covered = std::count_if(result.corners.begin(), result.corners.end(), [](int count) { return count > 0; });
  result.share = static_cast<double>(covered) / static_cast<double>(result.corners.size());
  return result;
}

}  // namespace panvo::calibration
