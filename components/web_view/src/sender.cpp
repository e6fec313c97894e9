// SPDX-License-Identifier: Apache-2.0
#include "sender.hpp"

#include <chrono>
#include <utility>

#include "server_message.hpp"

namespace panvo::web_view {
namespace {

// A failure to send after a shorter time means that the client has left.
constexpr std::chrono::seconds kStall{3};

}  // namespace

Sender::Sender(WebServer::Connection& connection, Limits limits, ImageCompressor& compressor,
               std::function<void()> on_stalled)
    : connection_(connection),
      compressor_(compressor),
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

void Sender::send_binary(std::vector<std::uint8_t> frame) {
  const std::size_t bytes = frame.size();
  push({SendQueue::Binary{std::move(frame)}, bytes});
}

void Sender::send_message(std::uint32_t subscription, std::int64_t time_ns, const runtime::SamplePtr& sample,
                          bool is_to_compress) {
  const std::size_t bytes = sample->serialized_size();
  push({SendQueue::Message{subscription, time_ns, sample, is_to_compress}, bytes,
        keeping_of(sample->type_name(), bytes)});
}

void Sender::push(SendQueue::Item item) {
  {
    const std::lock_guard lock(mutex_);
    if (is_full_ || is_broken_) return;
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
  bool is_stalled = false;
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return is_ending_ || is_full_ || is_broken_ || !queue_.is_empty(); });
    if (is_ending_) return;
    is_stalled = is_stalled || is_full_;
    if (is_full_ || is_broken_) break;
    const auto item = queue_.pop();
    lock.unlock();
    const auto start = std::chrono::steady_clock::now();
    const bool is_sent = send(*item);
    is_stalled = !is_sent && std::chrono::steady_clock::now() - start >= kStall;
    lock.lock();
    is_broken_ = !is_sent;
  }
  lock.unlock();
  if (is_stalled) on_stalled_();
  connection_.close();
}

bool Sender::send(const SendQueue::Item& item) {
  if (const auto* text = std::get_if<SendQueue::Text>(&item.content)) return connection_.send_text(text->json);
  if (const auto* binary = std::get_if<SendQueue::Binary>(&item.content)) return connection_.send_binary(binary->frame);
  return send(std::get<SendQueue::Message>(item.content));
}

bool Sender::send(const SendQueue::Message& message) {
  const auto sample = message.is_to_compress ? compressor_.compressed(message.sample) : message.sample;
  if (!sample) return true;  // nothing to send
  frame_ = message_head(message.subscription, message.time_ns);
  const auto& bytes = sample->bytes();
  frame_.insert(frame_.end(), bytes.begin(), bytes.end());
  return connection_.send_binary(frame_);
}

}  // namespace panvo::web_view
