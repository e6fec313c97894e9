// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "panvo/runtime/sample.hpp"

namespace panvo::web_view {

/// Which waiting messages a newer one may replace.
enum class Keeping {
  kAll,        ///< poses and other small messages: none is dropped
  kWhileRoom,  ///< large messages: the oldest are dropped when the queue is full
  kNewest,     ///< images: only the newest of a subscription waits
};

/// By message type, such as "sensor_msgs/msg/Image", and size.
Keeping keeping_of(std::string_view type_name, std::size_t bytes);

/// What waits to be sent to one client. Small messages go before large ones, so a pose never waits behind waiting
/// images; the messages of one subscription keep their order. Not thread-safe.
class SendQueue {
 public:
  /// A message of a subscription. It is serialised only when it is sent.
  struct Message {
    std::uint32_t subscription;
    std::int64_t time_ns;  ///< for the client
    runtime::SamplePtr sample;
    bool is_to_compress = false;  ///< an image, when it is sent
  };
  struct Text {
    std::string json;
  };
  struct Binary {
    std::vector<std::uint8_t> frame;
  };
  struct Item {
    std::variant<Message, Text, Binary> content;
    std::size_t bytes;
    Keeping keeping = Keeping::kAll;
  };

  /// Both bounds are of all waiting items together.
  SendQueue(std::size_t max_bytes, std::size_t max_items) : max_bytes_(max_bytes), max_items_(max_items) {}

  /// Returns false if the queue is full even after dropping all droppable messages: the client does not read.
  [[nodiscard]] bool push(Item item);
  std::optional<Item> pop();

  /// Removes the waiting messages of a subscription that has ended.
  void forget(std::uint32_t subscription);

  bool is_empty() const { return urgent_.empty() && bulk_.empty(); }
  std::size_t bytes() const { return bytes_; }
  /// Messages dropped so far.
  std::uint64_t dropped() const { return dropped_; }

 private:
  bool has_room(const Item& item) const;
  void drop_older(std::uint32_t subscription);
  void drop_oldest();

  const std::size_t max_bytes_, max_items_;
  std::deque<Item> urgent_, bulk_;
  std::set<std::uint32_t> bulky_;  // subscriptions that had a large message: all later ones queue behind it
  std::size_t bytes_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace panvo::web_view
