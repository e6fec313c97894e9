// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace panvo::camera_stream {

/// How devices number their frames.
enum class FrameNumbering {
  kGigEVision,  ///< 16 bits, 1 follows 65535, 0 is none; or 64 bits, told by numbers that 16 bits cannot hold
  kCounter32,   ///< 32 bits, 0 follows the largest (V4L2 sequence numbers)
  kCounter64,   ///< 64 bits (USB3 Vision)
};

/// Finds the frames that were taken and did not come, from the numbers of those that did.
class FrameGaps {
 public:
  explicit FrameGaps(FrameNumbering numbering) : numbering_(numbering) {}

  /// How many frames are missing between the one before and this one. 0 for the first, and for a number that goes far back: the device has begun
  /// anew. -1 for one that comes late: it was counted as missing.
  std::int64_t missing_before(std::uint64_t number);

  /// The stream begins anew: the next number follows nothing.
  void restart() { last_.reset(); }

 private:
  FrameNumbering numbering_;
  std::optional<std::uint64_t> last_;
};

}  // namespace panvo::camera_stream
