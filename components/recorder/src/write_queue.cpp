// SPDX-License-Identifier: Apache-2.0
#include "write_queue.hpp"

#include <utility>

namespace panvo::recorder {

bool WriteQueue::push(const runtime::TopicDescription& topic, const runtime::SamplePtr& sample) {
  {
    const std::lock_guard lock(mutex_);
    if (closed_ || taken_bytes_ >= max_bytes_ || taken_items_ + 1 >= max_items_) {
      ++dropped_[topic.name];
      return false;
    }
  }
  const auto size = sample->bytes().size();  // may serialize the message: without the lock, and not if it is dropped
  const std::lock_guard lock(mutex_);
  taken_bytes_ += size;
  ++taken_items_;
  items_.push_back({&topic, sample});
  return true;
}

void WriteQueue::push_split() {
  const std::lock_guard lock(mutex_);
  ++taken_items_;
  items_.emplace_back();
}

std::optional<WriteQueue::Item> WriteQueue::pop() {
  const std::lock_guard lock(mutex_);
  if (closed_ || items_.empty()) {
    return std::nullopt;
  }
  auto item = std::move(items_.front());
  items_.pop_front();
  return item;
}

void WriteQueue::release(const Item& item) {
  const auto size = item.sample ? item.sample->bytes().size() : 0;
  const std::lock_guard lock(mutex_);
  taken_bytes_ -= size;
  --taken_items_;
}

void WriteQueue::close() {
  std::deque<Item> left;  // destroyed without the lock, as this may free much memory
  const std::lock_guard lock(mutex_);
  closed_ = true;
  left.swap(items_);
  for (const auto& item : left) {
    if (item.topic) {
      ++dropped_[item.topic->name];
    }
  }
}

bool WriteQueue::is_closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

std::map<std::string, std::uint64_t> WriteQueue::take_dropped() {
  const std::lock_guard lock(mutex_);
  return std::exchange(dropped_, {});
}

}  // namespace panvo::recorder
