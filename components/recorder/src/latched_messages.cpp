// SPDX-License-Identifier: Apache-2.0
#include "latched_messages.hpp"

#include <algorithm>

namespace panvo::recorder {

void LatchedMessages::add(int topic, std::span<const std::uint8_t> data) {
  if (data.size() > max_bytes_) return;
  const auto same = std::find_if(messages_.begin(), messages_.end(), [&](const Message& message) {
    return message.topic == topic && std::ranges::equal(message.data, data);
  });
  if (same != messages_.end()) remove(same);
  const auto is_of_topic = [topic](const Message& message) { return message.topic == topic; };
  if (std::count_if(messages_.begin(), messages_.end(), is_of_topic) >= static_cast<std::ptrdiff_t>(kMostOfTopic)) {
    remove(std::find_if(messages_.begin(), messages_.end(), is_of_topic));
  }
  while (bytes_ + data.size() > max_bytes_) remove(messages_.begin());
  messages_.push_back({topic, {data.begin(), data.end()}});
  bytes_ += data.size();
}

void LatchedMessages::remove(std::deque<Message>::iterator message) {
  bytes_ -= message->data.size();
  messages_.erase(message);
}

}  // namespace panvo::recorder
