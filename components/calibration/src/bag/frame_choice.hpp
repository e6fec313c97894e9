// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace panvo::calibration {

/// Of a camera's stamps (ns), in any order, those that are `every_ns` or more after the last one taken.
std::vector<std::int64_t> choose_frames(std::vector<std::int64_t> stamps_ns, std::int64_t every_ns);

/// The one of `chosen_ns` (sorted) nearest to `stamp_ns`; nullopt: none within `tolerance_ns`.
std::optional<std::int64_t> nearest_frame(const std::vector<std::int64_t>& chosen_ns, std::int64_t stamp_ns,
                                          std::int64_t tolerance_ns);

}  // namespace panvo::calibration
