// SPDX-License-Identifier: Apache-2.0
#include "panvo/postgres/worker.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

namespace panvo::postgres {

struct Worker::Shared {
  std::function<bool()> step;
  std::mutex content;  // of the users
  std::mutex mutex;    // of the fields below
  std::condition_variable changed;
  bool has_work = false;
  bool ends = false;
  std::thread thread;

  void run() {
    while (true) {
      {
        std::unique_lock lock(mutex);
        changed.wait(lock, [this] { return has_work || ends; });
        if (ends) return;
        has_work = false;
        is_working = true;
      }
      while (step()) {
        const std::lock_guard lock(mutex);
        if (ends) break;
      }
      const std::lock_guard lock(mutex);
      is_working = false;
      changed.notify_all();
    }
  }

  bool is_working = false;
};

int backoff_ms(int attempt) noexcept { return std::min(30'000, 250 << std::clamp(attempt, 0, 10)); }

bool sleep_before_attempt(int attempt, int most) {
  if (attempt >= most) return false;
  std::this_thread::sleep_for(std::chrono::milliseconds(backoff_ms(attempt)));
  return true;
}

Worker::Worker(std::function<bool()> step) : shared_(std::make_unique<Shared>()) {
  shared_->step = std::move(step);
  shared_->thread = std::thread([shared = shared_.get()] { shared->run(); });
}

Worker::~Worker() { finish(0); }

void Worker::locked(const std::function<void()>& action) const {
  const std::lock_guard lock(shared_->content);
  action();
}

void Worker::wake() {
  const std::lock_guard lock(shared_->mutex);
  shared_->has_work = true;
  shared_->changed.notify_all();
}

bool Worker::pause(int wait_ms) {
  std::unique_lock lock(shared_->mutex);
  return !shared_->changed.wait_for(lock, std::chrono::milliseconds(wait_ms), [this] { return shared_->ends; });
}

bool Worker::finish(int limit_ms) {
  if (!shared_->thread.joinable()) return true;
  bool is_done = false;
  {
    std::unique_lock lock(shared_->mutex);
    is_done = shared_->changed.wait_for(lock, std::chrono::milliseconds(limit_ms),
                                        [this] { return !shared_->has_work && !shared_->is_working; });
    shared_->ends = true;
    shared_->changed.notify_all();
  }
  shared_->thread.join();
  return is_done;
}

}  // namespace panvo::postgres
