// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/localizer/localizer.hpp"
#include "panvo/runtime/logger.hpp"

namespace panvo::localizer {

/// Logs each clock offset or misalignment of the cameras that was detected on the journey once.
class AlignmentNotices {
 public:
  /// `log` must outlive it.
  explicit AlignmentNotices(const runtime::Logger& log) : log_(log) {}

  void report_clock(const ClockOffset& clock);
  void report_direction(const DirectionOffset& offset);
  void report_mounting(const ExtrinsicsMonitor& mounting);

 private:
  const runtime::Logger& log_;
  bool has_reported_offset_ = false;
  bool has_reported_direction_ = false;
  bool has_reported_mounting_ = false;
};

}  // namespace panvo::localizer
