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

/// Puts together what several cameras took at once, by stamp. Frames that stay alone are let go.
template <class Frame>
class FrameSets {
 public:
  struct Set {
    std::int64_t stamp_ns = 0;  ///< of the first camera
    std::vector<Frame> frames;  ///< by camera
  };

  FrameSets(std::size_t cameras, std::int64_t tolerance_ns) : waiting_(cameras), tolerance_ns_(tolerance_ns) {}

  /// Takes a frame; when it is the last of a set, that set: of each other camera the frame nearest in time. It, and all frames
  /// before it, are then gone.
  std::optional<Set> push(std::size_t camera, std::int64_t stamp_ns, Frame frame) {
    waiting_[camera].emplace_back(stamp_ns, std::move(frame));
    if (waiting_[camera].size() > kMostWaiting) waiting_[camera].pop_front();
    std::vector<std::size_t> places;
    std::int64_t farthest_ns = 0;
    for (const auto& frames : waiting_) {
      if (frames.empty()) return std::nullopt;
      const auto nearest = std::min_element(frames.begin(), frames.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.first - stamp_ns) < std::abs(b.first - stamp_ns);
      });
      places.push_back(static_cast<std::size_t>(nearest - frames.begin()));
      farthest_ns = std::max(farthest_ns, std::abs(nearest->first - stamp_ns));
    }
    closest_ns_ = std::min(closest_ns_.value_or(farthest_ns), farthest_ns);
    if (farthest_ns > tolerance_ns_) return std::nullopt;
    Set set{waiting_.front()[places.front()].first, {}};
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      set.frames.push_back(std::move(waiting_[i][places[i]].second));
      waiting_[i].erase(waiting_[i].begin(), waiting_[i].begin() + static_cast<std::ptrdiff_t>(places[i]) + 1);
    }
    return set;
  }

  /// How far apart in time the frames of the best set so far were, whether it was close enough or not; nullopt: some camera never had one.
  std::optional<std::int64_t> closest_ns() const { return closest_ns_; }

 private:
  static constexpr std::size_t kMostWaiting = 10;  // of a camera: a third of a second at 30 Hz

  std::vector<std::deque<std::pair<std::int64_t, Frame>>> waiting_;  // by camera
  std::int64_t tolerance_ns_;
  std::optional<std::int64_t> closest_ns_;
};

}  // namespace panvo::calibration
