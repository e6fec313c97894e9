// SPDX-License-Identifier: Apache-2.0
#include "panvo/dataset_player/passes.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "panvo/interfaces/stamp_range.hpp"

namespace panvo::dataset_player {

Passes::Passes(std::vector<TimelineEvent> events, std::uint64_t count) : first_(std::move(events)) {
  size_ = first_.size();
  if (count <= 1) return;
  // An inertial measurement of a drive is none of the drive backward.
  std::erase_if(first_, [](const TimelineEvent& event) { return event.kind == TimelineEvent::Kind::kImu; });
  const auto is_image = [](const TimelineEvent& event) { return event.kind != TimelineEvent::Kind::kGroundTruth; };
  begin_ns_ = std::find_if(first_.begin(), first_.end(), is_image)->stamp_ns;
  const std::int64_t end_ns = std::find_if(first_.rbegin(), first_.rend(), is_image)->stamp_ns;
  length_ns_ = end_ns - begin_ns_;
  const auto longest_ns = (interfaces::kEndOfStamps_ns - 1 - begin_ns_) / static_cast<std::int64_t>(count);
  if (length_ns_ > longest_ns) {
    throw DatasetError(std::to_string(count) + " passes end later than stamps can be, in 2038; play fewer (passes)");
  }
  // Ground truth after the last image would overlap with the next pass.
  std::erase_if(first_, [&](const TimelineEvent& event) { return event.stamp_ns > end_ns; });
  for (auto event : first_) {
    if (event.stamp_ns <= begin_ns_) continue;
    event.stamp_ns -= begin_ns_;
    forth_.push_back(event);
  }
  for (auto event : first_) {
    if (event.stamp_ns < begin_ns_ || event.stamp_ns == end_ns) continue;
    event.stamp_ns = end_ns - event.stamp_ns;
    back_.push_back(event);
  }
  // Stable, so that at equal stamps ground truth comes first, then stereo, in this direction too.
  std::stable_sort(back_.begin(), back_.end(),
                   [](const TimelineEvent& a, const TimelineEvent& b) { return a.stamp_ns < b.stamp_ns; });
  size_ = first_.size() + (count / 2) * back_.size() + ((count - 1) / 2) * forth_.size();
}

TimelineEvent Passes::operator[](std::uint64_t i) const {
  if (i < first_.size()) return first_[i];
  const std::uint64_t both = back_.size() + forth_.size();
  const std::uint64_t round = (i - first_.size()) / both, in_round = (i - first_.size()) % both;
  const bool is_back = in_round < back_.size();
  const std::uint64_t pass = 1 + 2 * round + (is_back ? 0 : 1);
  TimelineEvent event = is_back ? back_[in_round] : forth_[in_round - back_.size()];
  event.stamp_ns += begin_ns_ + static_cast<std::int64_t>(pass) * length_ns_;
  return event;
}

}  // namespace panvo::dataset_player
