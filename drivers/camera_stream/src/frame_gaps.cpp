// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/frame_gaps.hpp"

namespace panvo::camera_stream {
namespace {

constexpr std::uint64_t kMax16 = 65535;

constexpr std::int64_t kLate = 16;  // a number further back than this means a restarted device, not a late frame

/// Signed distance from `last` to `number` in a counter that wraps after `period` numbers.
std::int64_t steps_on(std::uint64_t last, std::uint64_t number, std::uint64_t period) {
  const auto steps = static_cast<std::int64_t>((number + period - last) % period);
  return steps >= static_cast<std::int64_t>(period / 2) ? steps - static_cast<std::int64_t>(period) : steps;
}

}  // namespace

std::int64_t FrameGaps::missing_before(std::uint64_t number) {
  if (numbering_ == FrameNumbering::kGigEVision && number == 0) return 0;  // the device does not number this frame
  std::int64_t steps = 1;
  if (last_ && numbering_ == FrameNumbering::kCounter32) {
    steps = steps_on(*last_, number, std::uint64_t{1} << 32);
  } else if (last_ && numbering_ == FrameNumbering::kGigEVision && number <= kMax16 && *last_ <= kMax16) {
    steps = steps_on(*last_, number, kMax16);
  } else if (last_) {
    steps = static_cast<std::int64_t>(number - *last_);
  }
  if (steps < 0 && steps >= -kLate) return -1;
  last_ = number;
  return steps > 1 ? steps - 1 : 0;
}

}  // namespace panvo::camera_stream
