// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "panvo/dataset_player/timeline.hpp"

namespace panvo::dataset_player {

/// A recording played forward, backward, forward, ... with stamps that go on increasing: the vehicle returns on its own path, so that no pass begins
/// with a jump. The frame at a turning point is played once.
class Passes {
 public:
  Passes() = default;
  /// `events` as timeline() returns them; `count` of passes, at least 1. One pass is `events` unchanged.
  Passes(std::vector<TimelineEvent> events, std::uint64_t count);

  std::uint64_t size() const noexcept { return size_; }
  /// The event `i` < size(), with its stamp in this playback.
  TimelineEvent operator[](std::uint64_t i) const;

 private:
  std::vector<TimelineEvent> first_;         // pass 0
  std::vector<TimelineEvent> back_, forth_;  // every odd, every other even pass; stamps from the pass's begin
  std::int64_t begin_ns_ = 0, length_ns_ = 0;
  std::uint64_t size_ = 0;
};

}  // namespace panvo::dataset_player
