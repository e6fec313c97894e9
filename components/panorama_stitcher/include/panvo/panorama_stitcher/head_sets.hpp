// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "panvo/vision/stamp_sequence.hpp"

namespace panvo::panorama_stitcher {

/// Groups simultaneous images of the heads of a rig, whose stamps differ by at most a tolerance. A head absent from
/// several consecutive sets is considered missing; sets are completed without it until its next image. Unpaired images
/// are dropped and counted.
template <class Item>
class HeadSets {
 public:
  struct Settings {
    std::int64_t tolerance_ns = 5'000'000;  ///< must be less than half the image period of a head
    std::size_t depth = 8;                  ///< maximum number of incomplete sets; the oldest is dropped
    int missing_after = 5;                  ///< consecutive sets without a head until it is missing
  };
  struct Set {
    std::int64_t stamp_ns = 0;  ///< of the first image, in head order
    std::vector<std::optional<Item>> items;
  };

  HeadSets(std::size_t heads, const Settings& settings) : settings_(settings), heads_(heads) {
    if (heads == 0 || settings.depth == 0 || settings.missing_after < 1 || settings.tolerance_ns < 0)
      throw std::invalid_argument(
          "HeadSets needs heads, depth and missing_after of at least 1, and tolerance_ns of at least 0");
  }

  /// Adds an image. Returns the sets that it completes, oldest first.
  std::vector<Set> push(std::size_t head, std::int64_t stamp_ns, Item item) {
    heads_.at(head).is_missing = false;
    if (heads_[head].stamps.add(stamp_ns) == vision::StampOrder::kSetBack) forget_after(stamp_ns);
    if (last_ns_ && stamp_ns <= *last_ns_ + settings_.tolerance_ns) {
      ++heads_[head].unpaired;  // its set is already complete or dropped
      return {};
    }
    auto& waiting = set_of(stamp_ns)[head];
    if (waiting) ++heads_[head].unpaired;
    waiting = {stamp_ns, std::move(item)};
    auto complete = take_complete();
    while (waiting_.size() > settings_.depth) {
      drop_oldest();
      auto more = take_complete();  // sets may be complete without a head that is now missing
      std::move(more.begin(), more.end(), std::back_inserter(complete));
    }
    return complete;
  }

  bool is_missing(std::size_t head) const { return heads_.at(head).is_missing; }
  /// Number of dropped images of the head.
  std::uint64_t unpaired(std::size_t head) const { return heads_.at(head).unpaired; }

 private:
  struct Head {
    bool is_missing = false;
    int absent = 0;  ///< consecutive sets without it
    std::uint64_t unpaired = 0;
    vision::StampSequence stamps;
  };
  struct Stamped {
    std::int64_t stamp_ns;
    Item item;
  };
  using Waiting = std::vector<std::optional<Stamped>>;

  Waiting& set_of(std::int64_t stamp_ns) {
    const auto near = waiting_.lower_bound(stamp_ns - settings_.tolerance_ns);
    if (near != waiting_.end() && near->first <= stamp_ns + settings_.tolerance_ns) return near->second;
    return waiting_.emplace(stamp_ns, Waiting(heads_.size())).first->second;
  }

  bool is_complete(const Waiting& set) const {
    bool has_any = false;
    for (std::size_t i = 0; i < heads_.size(); ++i) {
      if (!set[i] && !heads_[i].is_missing) return false;
      has_any = has_any || set[i];
    }
    return has_any;
  }

  std::vector<Set> take_complete() {
    std::vector<Set> sets;
    while (true) {
      const auto complete =
          std::find_if(waiting_.begin(), waiting_.end(), [&](const auto& entry) { return is_complete(entry.second); });
      if (complete == waiting_.end()) return sets;
      const std::int64_t key_ns = complete->first;
      while (waiting_.begin()->first != key_ns) drop_oldest();  // since each head's images arrive in order
      sets.push_back(take(std::move(waiting_.begin()->second)));
      last_ns_ = key_ns;
      waiting_.erase(waiting_.begin());
    }
  }

  Set take(Waiting&& waiting) {
    Set set;
    bool is_first = true;
    for (std::size_t i = 0; i < heads_.size(); ++i) {
      set.items.emplace_back();
      if (!waiting[i]) continue;
      heads_[i].absent = 0;
      if (std::exchange(is_first, false)) set.stamp_ns = waiting[i]->stamp_ns;
      set.items.back() = std::move(waiting[i]->item);
    }
    return set;
  }

  void drop_oldest() {
    const auto& [key_ns, set] = *waiting_.begin();
    for (std::size_t i = 0; i < heads_.size(); ++i) {
      if (set[i]) {
        ++heads_[i].unpaired;
        heads_[i].absent = 0;
      } else if (++heads_[i].absent >= settings_.missing_after) {
        heads_[i].is_missing = true;
      }
    }
    last_ns_ = key_ns;
    waiting_.erase(waiting_.begin());
  }

  /// The clock was set back: what is later is of the time before. Each head finds that out for itself, and leaves alone
  /// the sets of the new time that the others have begun.
  void forget_after(std::int64_t stamp_ns) {
    const auto later = waiting_.upper_bound(stamp_ns + settings_.tolerance_ns);
    for (auto set = later; set != waiting_.end(); ++set) {
      for (std::size_t i = 0; i < heads_.size(); ++i) {
        if (set->second[i]) ++heads_[i].unpaired;
      }
    }
    waiting_.erase(later, waiting_.end());
    if (last_ns_ && stamp_ns <= *last_ns_) last_ns_.reset();
  }

  Settings settings_;
  std::vector<Head> heads_;
  std::map<std::int64_t, Waiting> waiting_;  ///< by the stamp of the first image to arrive
  std::optional<std::int64_t> last_ns_;      ///< key of the newest set taken or dropped
};

}  // namespace panvo::panorama_stitcher
