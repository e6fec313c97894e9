// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <utility>

namespace panvo::landmarks {

/// What comes before it is known whether it is of use: the last ones, up to a number, and how many were dropped.
template <class Item>
class LastKept {
 public:
  explicit LastKept(std::size_t most) : most_(most) {}

  void add(Item item) {
    kept_.push_back(std::move(item));
    if (kept_.size() <= most_) return;
    kept_.pop_front();
    ++dropped_;
  }
  template <class Condition>
  void forget_if(Condition&& condition) {
    std::erase_if(kept_, condition);
  }
  bool empty() const noexcept { return kept_.empty(); }
  std::size_t most() const noexcept { return most_; }
  std::size_t dropped() const noexcept { return dropped_; }

  /// Those that were kept; begins again.
  std::deque<Item> take() {
    dropped_ = 0;
    return std::exchange(kept_, {});
  }

 private:
  std::size_t most_;
  std::size_t dropped_ = 0;
  std::deque<Item> kept_;
};

}  // namespace panvo::landmarks
