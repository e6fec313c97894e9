// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/sample.hpp"

namespace panvo::recorder {

/// Received messages that wait for the disk, of bounded size, and the numbers of those dropped. It belongs to the
/// recorder, since a stage discards its items when it stops. Thread-safe; one thread pushes.
class WriteQueue {
 public:
  struct Item {
    const runtime::TopicDescription* topic = nullptr;  ///< null: a request to start the next file
    runtime::SamplePtr sample{};
  };

  WriteQueue(std::size_t max_bytes, std::size_t max_items) : max_bytes_(max_bytes), max_items_(max_items) {}

  /// Returns false if the queue is full or closed; the message then counts as dropped.
  bool push(const runtime::TopicDescription& topic, const runtime::SamplePtr& sample);
  void push_split();

  /// The oldest item; none if the queue is empty or closed. It takes up room until it is released.
  std::optional<Item> pop();
  void release(const Item& item);

  /// Drops and counts all messages that wait and all later ones.
  void close();
  bool is_closed() const;

  /// Dropped messages by topic since the last call.
  std::map<std::string, std::uint64_t> take_dropped();

 private:
  const std::size_t max_bytes_, max_items_;
  mutable std::mutex mutex_;  // guards all below
  std::deque<Item> items_;
  std::size_t taken_bytes_ = 0, taken_items_ = 0;  // with those popped and not released
  std::map<std::string, std::uint64_t> dropped_;
  bool closed_ = false;
};

}  // namespace panvo::recorder
