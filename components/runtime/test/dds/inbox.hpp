// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <vector>

#include "test_messages.hpp"

namespace panvo::runtime::test {

/// Collects items from callbacks on other threads and waits for them.
template <class Item>
class Inbox {
 public:
  std::function<void(const Item&)> callback() {
    return [this](const Item& item) {
      const std::lock_guard lock(mutex_);
      items_.push_back(item);
      arrived_.notify_all();
    };
  }

  /// Waits for an item for which `wanted` holds; false at the limit.
  bool wait_for(const std::function<bool(const Item&)>& wanted) {
    std::unique_lock lock(mutex_);
    return arrived_.wait_for(lock, kLimit, [&] { return std::any_of(items_.begin(), items_.end(), wanted); });
  }

  /// The first `count` items; fewer at the limit.
  std::vector<Item> wait_for_count(std::size_t count) {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, kLimit, [&] { return items_.size() >= count; });
    return items_;
  }

  void clear() {
    const std::lock_guard lock(mutex_);
    items_.clear();
  }

  std::vector<Item> items() {
    const std::lock_guard lock(mutex_);
    return items_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<Item> items_;
};

}  // namespace panvo::runtime::test
