// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace panvo::test {

using Bytes = std::vector<std::uint8_t>;

/// Appends a number of so many bytes, the lowest first, as USB has them.
void put(Bytes& bytes, std::uint64_t number, int size);

/// A simulated camera: MJPG at `rate_hz` and half of it, YUY2 at 5 Hz, in one size.
struct CameraModel {
  std::string serial = "SERIAL";
  std::string product = "Stereo Camera";
  int width = 640, height = 240;  ///< px
  int rate_hz = 30;
};

inline constexpr std::uint8_t kMjpgFormat = 1, kYuy2Format = 2;          // by their place among the descriptors
inline constexpr std::uint8_t kCameraTerminal = 1, kProcessingUnit = 2;  // entities of the control interface
inline constexpr std::uint32_t kSlowest_hz = 5;
/// Bytes of a transfer, header and all.
inline constexpr std::uint32_t kPayloadBytes = 32 * 512;

/// Time between two frames as UVC tells it, 100 ns.
inline std::uint32_t interval_of(int rate_hz) { return 10'000'000U / static_cast<std::uint32_t>(rate_hz); }

Bytes device_descriptor();
/// The one configuration: a video control interface and a streaming interface with a bulk endpoint, as in USB Video Class 1.1.
Bytes configuration_descriptor(const CameraModel& model);
/// A text by its number in the device descriptor; empty: there is none of that number.
Bytes text_descriptor(const CameraModel& model, int number);

}  // namespace panvo::test
