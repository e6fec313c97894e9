// SPDX-License-Identifier: Apache-2.0
#include "frame_choice.hpp"

#include <algorithm>
#include <cstdlib>

namespace panvo::calibration {

std::vector<std::int64_t> choose_frames(std::vector<std::int64_t> stamps_ns, std::int64_t every_ns) {
  std::sort(stamps_ns.begin(), stamps_ns.end());
  std::vector<std::int64_t> chosen;
  for (const auto stamp : stamps_ns) {
    if (chosen.empty() || stamp - chosen.back() >= std::max<std::int64_t>(every_ns, 1)) chosen.push_back(stamp);
  }
  return chosen;
}

std::optional<std::int64_t> nearest_frame(const std::vector<std::int64_t>& chosen_ns, std::int64_t stamp_ns,
                                          std::int64_t tolerance_ns) {
  const auto after = std::lower_bound(chosen_ns.begin(), chosen_ns.end(), stamp_ns);
  std::optional<std::int64_t> nearest;
  for (const auto candidate : {after, after == chosen_ns.begin() ? after : after - 1}) {
    if (candidate == chosen_ns.end() || std::abs(*candidate - stamp_ns) > tolerance_ns) continue;
    if (!nearest || std::abs(*candidate - stamp_ns) < std::abs(*nearest - stamp_ns)) nearest = *candidate;
  }
  return nearest;
}

}  // namespace panvo::calibration
