// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "panvo/localizer/cross_check.hpp"
#include "panvo/vision/angle.hpp"

/// Directions of motion by panoramas and by odometry, and what they show of the two mounts.
namespace panvo::localizer {
namespace {

constexpr double kAlike_rad = 0.005;  // error common to the directions of all panoramas of a journey
constexpr double kSameAngle_rad = 0.1, kSameSigma_rad = kSameAngle_rad / 3.0;
constexpr double kSettled_rad = 0.006;  // a third of a degree: five references of a moving vehicle
// A stereo camera mounted so far askew shows it in its path; a panoramic camera looks the same at any rotation.
constexpr double kNoStereoMount_rad = 10.0 * vision::kDegree;

}  // namespace

/// One of the two cameras is rotated by that angle; which one is unknown. As long as the panoramas do not contradict it,
/// the stereo mount is known at least as well as it was measured; without panoramas it is trusted.
double CrossCheck::direction_sigma_rad() const {
  const DirectionOffset offset = latest_offset();
  if (!offset.is_measured()) return 0.0;
  const double off_rad = std::abs(offset.estimate_rad());
  const double turned_rad = off_rad > kNoStereoMount_rad ? 0.0 : std::max(0.0, off_rad - kAlike_rad);
  const double noise_rad = std::sqrt(offset.variance_rad2());
  return std::hypot(turned_rad,
                    stereo_mounting_sigma_rad_ * noise_rad / std::hypot(stereo_mounting_sigma_rad_, noise_rad));
}

std::optional<MountDirection> CrossCheck::mount_direction() const {
  if (lasting_ && lasting_->way_m > 0.0) {
    return MountDirection{vision::wrapped(lasting_->seen_rad + camera_turned_rad_), kSameSigma_rad * kSameSigma_rad};
  }
  const DirectionOffset offset = latest_offset();
  if (!offset.is_measured()) return std::nullopt;
  return MountDirection{vision::wrapped(offset.estimate_rad() + camera_turned_rad_), offset.variance_rad2()};
}

std::optional<Estimate> CrossCheck::settled_direction() const {
  const double sigma_rad = std::sqrt(direction_offset_.variance_rad2());
  if (!direction_offset_.is_measured() || lasting_ || sigma_rad > kSettled_rad) return std::nullopt;
  return Estimate{vision::wrapped(direction_offset_.estimate_rad() + camera_turned_rad_), sigma_rad};
}

/// With the last panorama.
DirectionOffset CrossCheck::latest_offset() const {
  DirectionOffset offset = direction_offset_;
  if (seen_) offset.add(seen_->difference_rad, seen_->variance_rad2);
  return offset;
}

double CrossCheck::allowed_rad(double variance_rad2, const DirectionOffset& offset) const {
  return contradiction_sigmas_ * std::sqrt(variance_rad2 + offset.variance_rad2());
}

/// What is known of the mounting before a measurement. One that contradicts what is only remembered shows that a camera
/// was mounted again, or its mount corrected: then as if nothing were remembered.
DirectionOffset CrossCheck::offset_before(const Seen& seen) const {
  DirectionOffset offset = direction_offset_;
  const double off_rad = std::abs(vision::wrapped(seen.difference_rad - offset.estimate_rad()));
  const bool is_other = off_rad > allowed_rad(seen.variance_rad2, offset);
  if (is_other && offset.is_only_remembered() && !turn_dispute_.is_on()) offset.forget_memory();
  return offset;
}

/// How long the directions have differed by one angle. If for long, the cause must be a camera's mounting.
auto CrossCheck::lasting_with(std::int64_t reference_ns, double seen_rad, double length_m) const -> Lasting {
  if (!lasting_ || std::abs(vision::wrapped(seen_rad - lasting_->seen_rad)) > kSameAngle_rad) {
    return {reference_ns, seen_rad, 0.0};
  }
  Lasting longer = *lasting_;
  if (longer.reference_ns != reference_ns) {
    longer.reference_ns = reference_ns;
    longer.way_m += length_m;
  }
  return longer;
}

}  // namespace panvo::localizer
