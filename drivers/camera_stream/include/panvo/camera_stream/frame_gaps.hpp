// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace panvo::camera_stream {

/// How devices number their frames.
enum class FrameNumbering {
  kGigEVision,  ///< 16 bits, wraps from 65535 to 1, 0: not numbered; 64 bits if larger numbers occur
  kCounter32,   ///< 32 bits, wraps to 0 (V4L2 sequence numbers)
  kCounter64,   ///< 64 bits (USB3 Vision)
};

/// Counts lost frames from the numbers of the received ones.
class FrameGaps {
 public:
  explicit FrameGaps(FrameNumbering numbering) : numbering_(numbering) {}

  /// Number of frames missing between the previous one and this one. 0 for the first, and for a number far below the
  /// previous one, which means that the device restarted. -1 for a late frame, which was counted as missing before.
  std::int64_t missing_before(std::uint64_t number);

  /// Call when the stream restarts: the next number has no predecessor.
  void restart() { last_.reset(); }

 private:
  FrameNumbering numbering_;
  std::optional<std::uint64_t> last_;
};

}  // namespace panvo::camera_stream
