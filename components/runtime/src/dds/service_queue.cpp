// SPDX-License-Identifier: Apache-2.0
#include "service_queue.hpp"

#include <pthread.h>

#include <algorithm>
#include <utility>

namespace panvo::runtime::dds {

ServiceQueue::~ServiceQueue() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    calls_.clear();
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

bool ServiceQueue::post(const void* owner, std::function<void()> call) {
  const std::lock_guard lock(mutex_);
  const auto waiting = std::ranges::count(calls_, owner, &Call::owner);
  if (stopping_ || static_cast<std::size_t>(waiting) >= kMaxWaiting) return false;
  calls_.push_back({owner, std::move(call)});
  if (!thread_.joinable()) {
    thread_ = std::thread([this] { run(); });
    pthread_setname_np(thread_.native_handle(), "services");
  }
  changed_.notify_all();
  return true;
}

void ServiceQueue::forget(const void* owner) {
  std::unique_lock lock(mutex_);
  std::erase_if(calls_, [owner](const Call& call) { return call.owner == owner; });
  if (thread_.get_id() == std::this_thread::get_id()) return;
  changed_.wait(lock, [&] { return running_ != owner; });
}

void ServiceQueue::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return stopping_ || !calls_.empty(); });
    if (stopping_) return;
    Call call = std::move(calls_.front());
    calls_.pop_front();
    running_ = call.owner;
    lock.unlock();
    call.run();
    call.run = nullptr;
    lock.lock();
    running_ = nullptr;
    changed_.notify_all();
  }
}

}  // namespace panvo::runtime::dds
