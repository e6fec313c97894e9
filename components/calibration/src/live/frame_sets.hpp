// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace panvo::calibration {

/// Groups simultaneous frames of several cameras by stamp. Discards frames without partners.
template <class Frame>
class FrameSets {
 public:
  struct Set {
    std::int64_t stamp_ns = 0;  ///< of the first camera
    std::vector<Frame> frames;  ///< by camera
  };

  /// `tolerance_ns`: largest time span of a set, from its first to its last frame.
  FrameSets(std::size_t cameras, std::int64_t tolerance_ns) : waiting_(cameras), tolerance_ns_(tolerance_ns) {}

  /// Adds a frame. If it completes a set, returns the set with the nearest frame in time of each other camera, and
  /// drops these and all earlier frames.
  std::optional<Set> push(std::size_t camera, std::int64_t stamp_ns, Frame frame) {
    waiting_[camera].emplace_back(stamp_ns, std::move(frame));
    if (waiting_[camera].size() > kMaxWaiting) waiting_[camera].pop_front();
    std::vector<std::size_t> places;
    std::int64_t first_ns = stamp_ns, last_ns = stamp_ns;
    for (const auto& frames : waiting_) {
      if (frames.empty()) return std::nullopt;
      const auto nearest = std::min_element(frames.begin(), frames.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.first - stamp_ns) < std::abs(b.first - stamp_ns);
      });
      places.push_back(static_cast<std::size_t>(nearest - frames.begin()));
      first_ns = std::min(first_ns, nearest->first);
      last_ns = std::max(last_ns, nearest->first);
    }
    const std::int64_t span_ns = last_ns - first_ns;
    closest_ns_ = std::min(closest_ns_.value_or(span_ns), span_ns);
    if (span_ns > tolerance_ns_) return std::nullopt;
    Set set{waiting_.front()[places.front()].first, {}};
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      set.frames.push_back(std::move(waiting_[i][places[i]].second));
      waiting_[i].erase(waiting_[i].begin(), waiting_[i].begin() + static_cast<std::ptrdiff_t>(places[i]) + 1);
    }
    return set;
  }

  /// Smallest time span of a set so far, whether within the tolerance or not; nullopt until each camera has sent a
  /// frame.
  std::optional<std::int64_t> closest_ns() const { return closest_ns_; }

 private:
  static constexpr std::size_t kMaxWaiting = 10;  // of a camera: a third of a second at 30 Hz

  std::vector<std::deque<std::pair<std::int64_t, Frame>>> waiting_;  // by camera
  std::int64_t tolerance_ns_;
  std::optional<std::int64_t> closest_ns_;
};

}  // namespace panvo::calibration
