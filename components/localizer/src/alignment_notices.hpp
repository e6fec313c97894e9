// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "panvo/localizer/localizer.hpp"
#include "panvo/runtime/logger.hpp"

namespace panvo::localizer {

/// Logs each clock offset or misalignment of the cameras that was detected on the journey once, an offset again when it
/// has changed; and what it lacks.
class AlignmentNotices {
 public:
  /// `log` must outlive it.
  explicit AlignmentNotices(const runtime::Logger& log) : log_(log) {}

  /// After a turn in the panoramas up to this stamp.
  void report_clock(const Localizer& localizer, std::int64_t panorama_ns, AzimuthUse use);
  void report_direction(const DirectionOffset& offset);
  void report_mounting(const ExtrinsicsMonitor& mounting);
  /// After an odometry pose: places or panoramas that do not come. `azimuth_ns`: stamp of the last turn, if any.
  void report_missing(const Localizer& localizer, std::optional<std::int64_t> azimuth_ns) const;

 private:
  void report_offset(const ClockOffset& clock);
  void report_unknown_clock(std::int64_t panorama_ns, bool is_unclear);

  const runtime::Logger& log_;
  double reported_offset_s_ = 0.0;
  std::int64_t panorama_ns_ = 0;  // of the last turn before the clock was known
  double unclear_s_ = 0.0;
  int unclear_ = 0;
  bool has_reported_direction_ = false;
  bool has_reported_mounting_ = false;
};

}  // namespace panvo::localizer
