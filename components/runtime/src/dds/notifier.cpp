// SPDX-License-Identifier: Apache-2.0
#include "notifier.hpp"

#include <exception>
#include <utility>

namespace panvo::runtime::dds {

Notifier::Notifier() : thread_([this] { run(); }) {}

Notifier::~Notifier() { stop(); }

void Notifier::post(std::function<void()> call) {
  const std::lock_guard lock(mutex_);
  post_locked(std::move(call));
}

void Notifier::post_after(std::chrono::milliseconds delay, std::function<void()> call) {
  const std::lock_guard lock(mutex_);
  if (stopping_) return;
  later_.emplace(Clock::now() + delay, std::move(call));
  wake_up_.notify_one();
}

void Notifier::post_locked(std::function<void()> call) {
  if (stopping_) return;
  calls_.push_back(std::move(call));
  wake_up_.notify_one();
}

void Notifier::warn(const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (!warned_.insert(text).second) return;
  if (warning_callback_) {
    post_locked([callback = warning_callback_, text] { callback(text); });
  } else {
    unheard_.push_back(text);
  }
}

void Notifier::on_warning(std::function<void(const std::string&)> callback) {
  const std::lock_guard lock(mutex_);
  warning_callback_ = std::move(callback);
  for (auto& text : std::exchange(unheard_, {})) {
    post_locked([heard_by = warning_callback_, text = std::move(text)] { heard_by(text); });
  }
}

void Notifier::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    calls_.clear();
    later_.clear();
    wake_up_.notify_one();
  }
  if (thread_.joinable()) thread_.join();
}

void Notifier::wait_for_call(std::unique_lock<std::mutex>& lock) {
  while (!stopping_ && calls_.empty()) {
    if (later_.empty()) {
      wake_up_.wait(lock);
    } else if (const auto first = later_.begin(); first->first <= Clock::now()) {
      calls_.push_back(std::move(first->second));
      later_.erase(first);
    } else {
      const auto due = first->first;  // it may be gone when the wait ends
      wake_up_.wait_until(lock, due);
    }
  }
}

void Notifier::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wait_for_call(lock);
    if (stopping_) return;
    const auto call = std::move(calls_.front());
    calls_.pop_front();
    lock.unlock();
    try {
      call();
    } catch (const std::exception& error) {
      warn(std::string("a callback of the DDS bridge failed: ") + error.what());
    }
    lock.lock();
  }
}

}  // namespace panvo::runtime::dds
