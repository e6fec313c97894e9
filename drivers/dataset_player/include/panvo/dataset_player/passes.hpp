// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "panvo/dataset_player/timeline.hpp"

namespace panvo::dataset_player {

/// Repeats a recording forward, backward, forward, ... with increasing stamps. The vehicle returns on its own path, so
/// that no pass begins with a jump. The frame at a turning point is played once.
class Passes {
 public:
  Passes() = default;
  /// `events`: from timeline(). `count`: number of passes, at least 1; one pass is `events` unchanged. Throws
  /// DatasetError if messages cannot hold the stamps of the last pass.
  Passes(std::vector<TimelineEvent> events, std::uint64_t count);

  std::uint64_t size() const noexcept { return size_; }
  /// The event `i` < size(), with its stamp in this playback.
  TimelineEvent operator[](std::uint64_t i) const;

 private:
  std::vector<TimelineEvent> first_;         // pass 0
  std::vector<TimelineEvent> back_, forth_;  // odd passes, even passes from 2 on; stamps relative to the pass's start
  std::int64_t begin_ns_ = 0, length_ns_ = 0;
  std::uint64_t size_ = 0;
};

}  // namespace panvo::dataset_player
