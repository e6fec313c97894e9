// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <span>

namespace panvo::aravis_camera::testing {

/// The picture of a simulated camera: its first bytes hold the camera index, the picture number and the time; each row
/// has a single grey level, so that a mixture of two pictures is detected.
struct TestPicture {
  std::uint64_t camera = 0, number = 0;
  std::int64_t taken_ns = 0;  ///< host clock

  static constexpr std::uint64_t kMark = 0x70616e766f313233;
  static constexpr std::size_t kHead = 4 * sizeof(std::uint64_t);

  std::uint8_t level(std::size_t row) const { return static_cast<std::uint8_t>(number + camera * 101 + row); }

  void draw(std::span<std::uint8_t> pixels, std::size_t width) const {
    for (std::size_t row = 0; (row + 1) * width <= pixels.size(); ++row)
      std::memset(pixels.data() + row * width, level(row), width);
    const std::uint64_t head[4] = {kMark, camera, number, static_cast<std::uint64_t>(taken_ns)};
    std::memcpy(pixels.data(), head, kHead);
  }

  /// nullopt: not a test picture, or a mixture of several.
  static std::optional<TestPicture> read(std::span<const std::uint8_t> pixels, std::size_t width) {
    if (pixels.size() < kHead || width < kHead || pixels.size() % width != 0) return std::nullopt;
    std::uint64_t head[4];
    std::memcpy(head, pixels.data(), kHead);
    if (head[0] != kMark) return std::nullopt;
    const TestPicture picture{head[1], head[2], static_cast<std::int64_t>(head[3])};
    for (std::size_t i = kHead; i < pixels.size(); ++i) {
      if (pixels[i] != picture.level(i / width)) return std::nullopt;
    }
    return picture;
  }
};

}  // namespace panvo::aravis_camera::testing
