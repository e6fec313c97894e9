// SPDX-License-Identifier: Apache-2.0
#include "slow_requests.hpp"

#include <utility>

#include "protocol_error.hpp"

namespace panvo::web_view {

SlowRequests::~SlowRequests() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void SlowRequests::add(std::function<void()> request) {
  const std::lock_guard lock(mutex_);
  if (waiting_.size() >= kMaxWaiting) throw ProtocolError("too many requests are waiting for an answer");
  if (!thread_.joinable()) thread_ = std::thread([this] { loop(); });
  waiting_.push_back(std::move(request));
  changed_.notify_all();
}

void SlowRequests::loop() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return is_ending_ || !waiting_.empty(); });
    if (is_ending_) return;
    const auto request = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    request();
    lock.lock();
  }
}

}  // namespace panvo::web_view
