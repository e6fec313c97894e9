// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace panvo::recorder {

/// The latest messages of latched topics, such as /tf_static: a file of a bag that has lost its first files is readable
/// alone if they are repeated at its start. A message that comes again replaces the earlier one.
class LatchedMessages {
 public:
  static constexpr std::size_t kMostOfTopic = 100;  ///< publishers of one topic, and their histories

  /// Keeps at most `max_bytes`; the oldest messages give way.
  explicit LatchedMessages(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  struct Message {
    int topic = 0;
    std::vector<std::uint8_t> data;
  };

  void add(int topic, std::span<const std::uint8_t> data);
  /// From the oldest to the newest.
  const std::deque<Message>& all() const noexcept { return messages_; }

 private:
  void remove(std::deque<Message>::iterator message);

  std::size_t max_bytes_;
  std::size_t bytes_ = 0;
  std::deque<Message> messages_;
};

}  // namespace panvo::recorder
