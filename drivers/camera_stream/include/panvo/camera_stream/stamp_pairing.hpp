// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <stdexcept>
#include <utility>
#include <vector>

namespace panvo::camera_stream {

/// Groups frames that several cameras took at the same time: one of each, with stamps within a tolerance. Frames
/// without partners are dropped and counted. Each camera's frames must arrive in order of stamp; the cameras in any
/// order.
template <class Item>
class StampPairing {
 public:
  struct Settings {
    std::size_t streams = 2;
    /// Largest stamp difference within a set; must be below half a frame period.
    std::int64_t tolerance_ns = 5'000'000;
    std::size_t depth = 8;  ///< waiting frames per camera; beyond that, the oldest is dropped
  };
  struct Set {
    std::int64_t stamp_ns = 0;  ///< common stamp: that of the first camera
    std::vector<Item> items;    ///< in order of the cameras
  };

  explicit StampPairing(const Settings& settings)
      : settings_(settings), waiting_(settings.streams), unpaired_(settings.streams) {
    if (settings.streams == 0 || settings.depth == 0 || settings.tolerance_ns < 0)
      throw std::invalid_argument("pairing needs at least one stream, a positive depth and a non-negative tolerance");
  }

  /// Returns the sets that this frame completes, oldest first.
  std::vector<Set> push(std::size_t stream, std::int64_t stamp_ns, Item item) {
    auto& queue = waiting_.at(stream);
    queue.push_back({stamp_ns, std::move(item)});
    std::vector<Set> sets;
    while (drop_those_too_old()) sets.push_back(take_fronts());
    if (queue.size() > settings_.depth) drop_front(stream);
    return sets;
  }

  /// Number of that camera's frames that were dropped without partners.
  std::uint64_t unpaired(std::size_t stream) const { return unpaired_.at(stream); }

 private:
  struct Waiting {
    std::int64_t stamp_ns;
    Item item;
  };

  void drop_front(std::size_t stream) {
    waiting_[stream].pop_front();
    ++unpaired_[stream];
  }

  /// Drops frames that cannot be paired, then returns whether the front frames of all queues form a set. A frame older
  /// than the newest front frame by more than the tolerance has no partner, because each camera's frames are in order.
  bool drop_those_too_old() {
    while (true) {
      if (std::any_of(waiting_.begin(), waiting_.end(), [](const auto& queue) { return queue.empty(); })) return false;
      std::int64_t newest_ns = waiting_.front().front().stamp_ns;
      for (const auto& queue : waiting_) newest_ns = std::max(newest_ns, queue.front().stamp_ns);
      bool is_set = true;
      for (std::size_t stream = 0; stream < waiting_.size(); ++stream) {
        if (newest_ns - waiting_[stream].front().stamp_ns <= settings_.tolerance_ns) continue;
        drop_front(stream);
        is_set = false;
      }
      if (is_set) return true;
    }
  }

  Set take_fronts() {
    Set set{waiting_.front().front().stamp_ns, {}};
    for (auto& queue : waiting_) {
      set.items.push_back(std::move(queue.front().item));
      queue.pop_front();
    }
    return set;
  }

  Settings settings_;
  std::vector<std::deque<Waiting>> waiting_;
  std::vector<std::uint64_t> unpaired_;
};

}  // namespace panvo::camera_stream
