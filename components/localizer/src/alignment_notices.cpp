// SPDX-License-Identifier: Apache-2.0
#include "alignment_notices.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace panvo::localizer {
namespace {

constexpr double kNotableOffset_s = 0.02;
constexpr double kSureOffset_s = 0.004, kSureShare = 0.25;  // standard deviation, or its share of the offset
constexpr double kNotableDirection_rad = 0.03;
constexpr double kSureDirection_rad = 0.006;

}  // namespace

void AlignmentNotices::report_clock(const ClockOffset& clock) {
  const bool is_sure =
      std::sqrt(clock.variance_s2()) < std::max(kSureOffset_s, kSureShare * std::abs(clock.estimate_s()));
  if (has_reported_offset_ || !is_sure || std::abs(clock.estimate_s()) <= kNotableOffset_s) return;
  has_reported_offset_ = true;
  log_.warn("the panoramic camera's clock is {:.0f} ms {} the stereo camera's; compensated",
            1000.0 * std::abs(clock.estimate_s()), clock.estimate_s() > 0.0 ? "ahead of" : "behind");
}

void AlignmentNotices::report_direction(const DirectionOffset& offset) {
  const bool is_sure = offset.is_measured() && std::sqrt(offset.variance_rad2()) < kSureDirection_rad;
  if (has_reported_direction_ || !is_sure || std::abs(offset.estimate_rad()) <= kNotableDirection_rad) return;
  has_reported_direction_ = true;
  log_.warn(
      "panoramas show a driving direction {:.1f} deg farther to the {} than stereo odometry: one of the cameras "
      "is rotated relative to /tf_static, and the position is uncertain accordingly",
      std::abs(offset.estimate_rad()) * 180.0 / std::numbers::pi, offset.estimate_rad() > 0.0 ? "left" : "right");
}

void AlignmentNotices::report_mounting(const ExtrinsicsMonitor& mounting) {
  const auto misalignment = mounting.misalignment();
  if (!misalignment || has_reported_mounting_) return;
  has_reported_mounting_ = true;
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  if (misalignment->is_turned) {
    log_.warn(
        "the panoramic camera looks {:+.1f} deg to the left and {:+.1f} deg down relative to /tf_static, or the stereo "
        "camera by the opposite angles: calibrate the extrinsics",
        kDegrees * misalignment->yaw_rad, kDegrees * misalignment->pitch_rad);
  }
  if (misalignment->is_displaced) {
    log_.warn(
        "the panoramic camera is {:+.2f} m forward and {:+.2f} m to the left relative to /tf_static, or the stereo "
        "camera by the opposite distances: measure the extrinsics",
        misalignment->forward_m, misalignment->left_m);
  }
}

}  // namespace panvo::localizer
