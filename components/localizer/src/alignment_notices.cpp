// SPDX-License-Identifier: Apache-2.0
#include "alignment_notices.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "panvo/vision/clock_search.hpp"
#include "panvo/vision/seconds.hpp"

namespace panvo::localizer {
namespace {

constexpr double kNotableOffset_s = 0.02;
constexpr double kSureOffset_s = 0.004, kSureShare = 0.25;  // standard deviation, or its share of the offset
constexpr double kMaxInterval_s = 1.0;                      // of panoramas: more is a gap
// An offset within reach shows in the first bend, by about seven turns.
constexpr int kManyTurns = 15;
constexpr double kInBends_s = 4.0;
constexpr double kNotableDirection_rad = 0.03;
constexpr double kSureDirection_rad = 0.006;
constexpr double kNoPanorama_s = 10.0;
constexpr double kUnlocatedFor_m = 500.0;  // by then a mapped place should have been passed

}  // namespace

/// Before the clock is known, the filter moves towards an offset that is too large for it.
void AlignmentNotices::report_clock(const Localizer& localizer, std::int64_t panorama_ns, AzimuthUse use) {
  if (localizer.is_clock_known()) return report_offset(localizer.panorama_clock());
  report_unknown_clock(panorama_ns, use == AzimuthUse::kUnclear);
}

void AlignmentNotices::report_offset(const ClockOffset& clock) {
  const bool is_sure =
      std::sqrt(clock.variance_s2()) < std::max(kSureOffset_s, kSureShare * std::abs(clock.estimate_s()));
  const double changed_s = clock.estimate_s() - reported_offset_s_;
  if (!is_sure || std::min(std::abs(changed_s), std::abs(clock.estimate_s())) <= kNotableOffset_s) return;
  reported_offset_s_ = clock.estimate_s();
  log_.warn("the panoramic camera's clock is {:.0f} ms {} the stereo camera's; compensated",
            1000.0 * std::abs(clock.estimate_s()), clock.estimate_s() > 0.0 ? "ahead of" : "behind");
}

void AlignmentNotices::report_unknown_clock(std::int64_t panorama_ns, bool is_unclear) {
  const double since_s = vision::seconds(panorama_ns_, panorama_ns);
  panorama_ns_ = panorama_ns;
  if (!is_unclear) return;
  ++unclear_;
  unclear_s_ += std::clamp(since_s, 0.0, kMaxInterval_s);
  if (unclear_ < kManyTurns || unclear_s_ < kInBends_s) return;
  log_.warn_throttled(
      "clock",
      "no offset of the panoramic camera's clock up to {:.1f} s makes its turns agree with the stereo odometry's: "
      "synchronise the clocks and check /tf_static; until then panoramas correct no turn",
      vision::ClockSearch::kFarthest_s);
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

void AlignmentNotices::report_missing(const Localizer& localizer, std::optional<std::int64_t> azimuth_ns) const {
  if (localizer.latest().state == State::kUnlocated && localizer.way_m() > kUnlocatedFor_m) {
    log_.warn_throttled("nothing recognised",
                        "no landmark of the loaded map was recognised in {:.0f} m: is it a map of another area?",
                        kUnlocatedFor_m);
  }
  if (azimuth_ns && vision::seconds(*azimuth_ns, localizer.latest().stamp_ns) > kNoPanorama_s) {
    log_.warn_throttled("no panorama", "no panorama for {:.0f} s: the pose drifts with the stereo odometry",
                        kNoPanorama_s);
  }
}

}  // namespace panvo::localizer
