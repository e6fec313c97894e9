// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace panvo::test {

using Bytes = std::vector<std::uint8_t>;

/// Appends a number of `size` bytes, little-endian as in USB.
void put(Bytes& bytes, std::uint64_t number, int size);

/// A simulated camera with one image size: MJPG at `rate_hz` and half of it, YUY2 at 5 Hz.
struct CameraModel {
  std::string serial = "SERIAL";
  std::string product = "Stereo Camera";
  int width = 640, height = 240;  ///< px
  int rate_hz = 30;
};

inline constexpr std::uint8_t kMjpgFormat = 1, kYuy2Format = 2;          // by order of the descriptors
inline constexpr std::uint8_t kCameraTerminal = 1, kProcessingUnit = 2;  // entities of the control interface
inline constexpr std::uint32_t kSlowest_hz = 5;
/// Bytes of a transfer, including the header.
inline constexpr std::uint32_t kPayloadBytes = 32 * 512;

/// Frame interval in the unit of UVC, 100 ns.
inline std::uint32_t interval_of(int rate_hz) { return 10'000'000U / static_cast<std::uint32_t>(rate_hz); }

Bytes device_descriptor();
/// The only configuration: a video control interface and a streaming interface with a bulk endpoint, as in USB Video
/// Class 1.1.
Bytes configuration_descriptor(const CameraModel& model);
/// String descriptor with a number from the device descriptor; empty for an unknown number.
Bytes text_descriptor(const CameraModel& model, int number);

}  // namespace panvo::test
