// SPDX-License-Identifier: Apache-2.0
#include "send_queue.hpp"

#include <utility>

namespace panvo::web_view {
namespace {

constexpr std::size_t kLarge = 65'536;  // bytes; a pose has less than 1000

bool is_of(const SendQueue::Item& item, std::uint32_t subscription) {
  const auto* message = std::get_if<SendQueue::Message>(&item.content);
  return message && message->subscription == subscription;
}

}  // namespace

Keeping keeping_of(std::string_view type_name, std::size_t bytes) {
  if (type_name == "sensor_msgs/msg/Image" || type_name == "sensor_msgs/msg/CompressedImage") return Keeping::kNewest;
  return bytes >= kLarge ? Keeping::kWhileRoom : Keeping::kAll;
}

bool SendQueue::has_room(const Item& item) const {
  return bytes_ + item.bytes <= max_bytes_ && urgent_.size() + bulk_.size() < max_items_;
}

bool SendQueue::push(Item item) {
  const auto* message = std::get_if<Message>(&item.content);
  if (message && item.keeping != Keeping::kAll) bulky_.insert(message->subscription);
  const bool is_bulk = message && bulky_.contains(message->subscription);
  if (message && item.keeping == Keeping::kNewest) drop_older(message->subscription);
  while (!has_room(item) && !bulk_.empty()) drop_oldest();
  if (!has_room(item)) {
    if (is_bulk) ++dropped_;
    return is_bulk;
  }
  bytes_ += item.bytes;
  (is_bulk ? bulk_ : urgent_).push_back(std::move(item));
  return true;
}

std::optional<SendQueue::Item> SendQueue::pop() {
  if (is_empty()) return std::nullopt;
  auto& queue = urgent_.empty() ? bulk_ : urgent_;
  Item item = std::move(queue.front());
  queue.pop_front();
  bytes_ -= item.bytes;
  return item;
}

void SendQueue::forget(std::uint32_t subscription) {
  for (auto* queue : {&urgent_, &bulk_}) {
    std::erase_if(*queue, [&](const Item& item) {
      if (!is_of(item, subscription)) return false;
      bytes_ -= item.bytes;
      return true;
    });
  }
  bulky_.erase(subscription);
}

void SendQueue::drop_older(std::uint32_t subscription) {
  std::erase_if(bulk_, [&](const Item& item) {
    if (!is_of(item, subscription)) return false;
    bytes_ -= item.bytes;
    ++dropped_;
    return true;
  });
}

void SendQueue::drop_oldest() {
  bytes_ -= bulk_.front().bytes;
  bulk_.pop_front();
  ++dropped_;
}

}  // namespace panvo::web_view
