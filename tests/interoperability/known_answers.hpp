// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

/// Contents of the messages exchanged with the other vendor: every field of message `n` has a different value, so that
/// omitted, swapped or misaligned fields are detected.
namespace panvo::test::answer {

/// Exactly representable as float.
constexpr double number(int field, int n) { return field * 0.25 - n * 64.0; }

constexpr std::uint32_t count(int field, int n) { return static_cast<std::uint32_t>(field * 1000 + n); }

constexpr std::uint8_t byte(std::size_t position, int n) {
  return static_cast<std::uint8_t>(position * 7 + position / 253 + static_cast<std::size_t>(n));
}

/// Different length for each message, so that the following fields are aligned differently.
inline std::string text(const char* start, int n) { return start + std::string(static_cast<std::size_t>(n % 5), '_'); }

// A panorama of 1.75 MB.
constexpr std::uint32_t kWidth = 1080, kHeight = 540, kStep = 3 * kWidth;

constexpr std::size_t kLargeFeatures = 20, kSmallFeatures = 3, kKeypoints = 7, kIntensities = 256;
constexpr std::size_t kThumbnailSize = 1001;
constexpr std::size_t transforms(int n) { return static_cast<std::size_t>(n % 3) + 1; }

}  // namespace panvo::test::answer
