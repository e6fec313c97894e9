// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/mounting_history.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "panvo/vision/angle.hpp"

namespace panvo::localizer {
namespace {

constexpr std::size_t kMostRecent = 1000;   // panoramas: minutes
constexpr double kCertain = 3.0;            // standard deviations
constexpr double kMountsAlike_rad = 0.005;  // between two directions of unturned mounts, in addition

}  // namespace

void MountingHistory::add(std::int64_t panorama_ns, const std::optional<MountDirection>& direction) {
  if (!direction) return;
  if (!first_) first_ = direction;
  now_ = direction;
  recent_.push_back({panorama_ns, *direction});
  if (recent_.size() > kMostRecent) recent_.pop_front();
}

void MountingHistory::add_built(std::uint32_t landmark_id, std::int64_t panorama_ns) {
  const auto then =
      std::find_if(recent_.rbegin(), recent_.rend(), [&](const At& at) { return at.panorama_ns <= panorama_ns; });
  if (then != recent_.rend()) built_[landmark_id] = then->direction;
}

void MountingHistory::forget_stamps() { recent_.clear(); }

double MountingHistory::turned_rad(std::uint32_t landmark_id) const {
  if (!now_) return 0.0;
  const auto built = built_.find(landmark_id);
  const MountDirection& then = built == built_.end() ? *first_ : built->second;
  const double errors_rad = kMountsAlike_rad + kCertain * std::sqrt(now_->variance_rad2 + then.variance_rad2);
  return std::max(0.0, std::abs(vision::wrapped(now_->rad - then.rad)) - errors_rad);
}

}  // namespace panvo::localizer
