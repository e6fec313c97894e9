// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/odometry_join.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "panvo/conversions/time.hpp"

namespace panvo::conversions {
namespace {

constexpr std::size_t kMaxQualities = 100;
constexpr std::size_t kMaxWaiting = 10;
// Both are published at the same time; a busy network delays them by a tenth of this.
constexpr std::int64_t kPatience_ns = 200'000'000;
constexpr int kMaxMissing = 10;  // consecutive messages without quality, after which none is awaited

}  // namespace

void OdometryJoin::add(const panvo_msgs::msg::OdometryQuality& quality) {
  has_quality_ = true;
  lacking_ = 0;
  const double ratio = quality.inlier_ratio();
  qualities_[stamp_ns(quality)] = {quality.reliable(), std::isfinite(ratio) ? std::clamp(1.0 - ratio, 0.0, 1.0) : 1.0,
                                   quality.lean_sigma_rad_per_m()};
  if (qualities_.size() > kMaxQualities) qualities_.erase(qualities_.begin());
}

void OdometryJoin::add(std::shared_ptr<const nav_msgs::msg::Odometry> odometry, std::int64_t now_ns) {
  waiting_.push_back({std::move(odometry), now_ns});
}

std::optional<OdometryJoin::Joined> OdometryJoin::next(std::int64_t now_ns, bool is_quality_published) {
  if (waiting_.empty()) return std::nullopt;
  const std::int64_t wanted_ns = stamp_ns(*waiting_.front().odometry);
  Joined joined{.odometry = waiting_.front().odometry, .quality = {}};
  if (const auto own = qualities_.find(wanted_ns); own != qualities_.end()) {
    joined.quality = own->second;
    qualities_.erase(qualities_.begin(), std::next(own));
  } else if (is_quality_published && lacking_ < kMaxMissing) {
    // Topics keep their order: a later quality means that this one was lost.
    const bool is_lost = qualities_.upper_bound(wanted_ns) != qualities_.end();
    const bool is_patient = waiting_.size() <= kMaxWaiting && now_ns - waiting_.front().since_ns < kPatience_ns;
    if (!is_lost && is_patient) return std::nullopt;
    if (!is_lost) ++lacking_;
    joined.lacks_quality = true;
  }
  waiting_.pop_front();
  return joined;
}

}  // namespace panvo::conversions
