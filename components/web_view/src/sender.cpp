// SPDX-License-Identifier: Apache-2.0
#include "sender.hpp"

#include <utility>

#include "server_message.hpp"

namespace panvo::web_view {

Sender::Sender(WebSocketServer::Connection& connection, Limits limits, std::function<void()> on_stalled)
    : connection_(connection),
      on_stalled_(std::move(on_stalled)),
      queue_(limits.max_bytes, limits.max_items),
      thread_([this] { loop(); }) {}

Sender::~Sender() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Sender::send_text(std::string json) {
  const std::size_t bytes = json.size();
  push({SendQueue::Text{std::move(json)}, bytes});
}

void Sender::send_message(std::uint32_t subscription, const runtime::SamplePtr& sample) {
  const std::size_t bytes = sample->serialized_size();
  push({SendQueue::Message{subscription, sample}, bytes, keeping_of(sample->type_name(), bytes)});
}

void Sender::push(SendQueue::Item item) {
  {
    const std::lock_guard lock(mutex_);
    if (is_full_) return;
    is_full_ = !queue_.push(std::move(item));
  }
  changed_.notify_one();
}

void Sender::forget(std::uint32_t subscription) {
  const std::lock_guard lock(mutex_);
  queue_.forget(subscription);
}

std::uint64_t Sender::dropped() const {
  const std::lock_guard lock(mutex_);
  return queue_.dropped();
}

void Sender::loop() {
  std::unique_lock lock(mutex_);
  bool is_sent = true;
  while (is_sent) {
    changed_.wait(lock, [this] { return is_ending_ || is_full_ || !queue_.is_empty(); });
    if (is_ending_) return;
    if (is_full_) break;
    const auto item = queue_.pop();
    lock.unlock();
    is_sent = send(*item);
    lock.lock();
    is_full_ = is_full_ || !is_sent;
  }
  if (is_ending_) return;
  lock.unlock();
  on_stalled_();
  connection_.close();
}

bool Sender::send(const SendQueue::Item& item) {
  if (const auto* text = std::get_if<SendQueue::Text>(&item.content)) return connection_.send_text(text->json);
  const auto& message = std::get<SendQueue::Message>(item.content);
  frame_ = message_head(message.subscription, message.sample->time_ns());
  const auto& bytes = message.sample->bytes();
  frame_.insert(frame_.end(), bytes.begin(), bytes.end());
  return connection_.send_binary(frame_);
}

}  // namespace panvo::web_view
