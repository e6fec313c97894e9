// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

/// Names in result files of the constants of panvo_msgs, from 1.
namespace panvo::runner {

template <std::size_t kCount>
using Names = std::array<std::string_view, kCount>;

inline constexpr Names<7> kLocalizationStates{"starting", "unlocated",   "tracking", "compass_only",
                                              "lost",     "relocalised", "stale"};
inline constexpr Names<5> kMatchStates{"searching", "locked", "matched", "rejected", "unusable"};
inline constexpr Names<4> kCorrectionStates{"full", "weak", "rotation_only", "rejected"};
inline constexpr Names<3> kOutcomes{"applied", "better_known", "rejected"};

/// The number itself for a value that is none of the constants.
template <std::size_t kCount>
std::string name_of(const Names<kCount>& names, std::uint8_t value) {
  return value >= 1 && value <= kCount ? std::string(names[value - 1U]) : std::to_string(value);
}

}  // namespace panvo::runner
