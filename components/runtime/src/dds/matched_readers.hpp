// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <set>
#include <utility>

#include "fast_dds.hpp"
#include "own_participants.hpp"

namespace panvo::runtime::dds {

/// The readers of other processes matched with a writer. Thread-safe.
class MatchedReaders final : public fdds::DataWriterListener {
 public:
  using Guid = rtps::GUID_t;

  bool contains(const Guid& reader) const {
    const std::lock_guard lock(mutex_);
    return readers_.contains(reader);
  }
  /// Whether a reader for which `is_wanted` holds is matched.
  template <class Wanted>
  bool contains_any(const Wanted& is_wanted) const {
    const std::lock_guard lock(mutex_);
    return std::ranges::any_of(readers_, is_wanted);
  }
  bool wait_for_any(std::chrono::milliseconds limit) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, limit, [&] { return !readers_.empty(); });
  }
  /// Sets the callback for each newly matched reader; it runs under this object's lock. Once this returns, the previous
  /// callback is no longer called.
  void on_match(std::function<void()> callback) {
    const std::lock_guard lock(mutex_);
    on_match_ = std::move(callback);
  }

 private:
  void on_publication_matched(fdds::DataWriter*, const fdds::PublicationMatchedStatus& status) override {
    const auto reader = rtps::iHandle2GUID(status.last_subscription_handle);
    if (is_of_this_process(reader)) return;
    const std::lock_guard lock(mutex_);
    if (status.current_count_change > 0) {
      readers_.insert(reader);
      if (on_match_) on_match_();
    } else {
      readers_.erase(reader);
    }
    changed_.notify_all();
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::set<Guid> readers_;
  std::function<void()> on_match_;
};

}  // namespace panvo::runtime::dds
