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
  const auto waiting =
      std::ranges::count_if(calls_, [owner](const Call& other) { return other.owner == owner && other.is_counted; });
  if (stopping_ || static_cast<std::size_t>(waiting) >= kMaxWaiting) return false;
  add({owner, Clock::now(), true, std::move(call)});
  return true;
}

void ServiceQueue::post_at(const void* owner, Clock::time_point due, std::function<void()> call) {
  const std::lock_guard lock(mutex_);
  if (!stopping_) add({owner, due, false, std::move(call)});
}

void ServiceQueue::add(Call call) {
  calls_.push_back(std::move(call));
  if (!thread_.joinable()) {
    thread_ = std::thread([this] { run(); });
    pthread_setname_np(thread_.native_handle(), "services");
  }
  changed_.notify_all();
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
    if (stopping_) return;
    const auto next = std::ranges::min_element(calls_, {}, &Call::due);
    if (next == calls_.end()) {
      changed_.wait(lock);
      continue;
    }
    if (const auto due = next->due; due > Clock::now()) {
      changed_.wait_until(lock, due);
      continue;
    }
    Call call = std::move(*next);
    calls_.erase(next);
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
