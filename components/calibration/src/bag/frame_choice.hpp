// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace panvo::calibration {

/// Selects from a camera's stamps (ns, any order) those at least `every_ns` after the previously selected one.
std::vector<std::int64_t> choose_frames(std::vector<std::int64_t> stamps_ns, std::int64_t every_ns);

/// The element of `chosen_ns` (sorted) nearest to `stamp_ns`; nullopt if none is within `tolerance_ns`.
std::optional<std::int64_t> nearest_frame(const std::vector<std::int64_t>& chosen_ns, std::int64_t stamp_ns,
                                          std::int64_t tolerance_ns);

}  // namespace panvo::calibration
