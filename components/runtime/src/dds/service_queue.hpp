// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace panvo::runtime::dds {

/// The thread and queue shared by the services of a bridge. Thread-safe.
class ServiceQueue {
 public:
  /// Per service.
  static constexpr std::size_t kMaxWaiting = 32;
  using Clock = std::chrono::steady_clock;

  ServiceQueue() = default;
  ~ServiceQueue();
  ServiceQueue(const ServiceQueue&) = delete;
  ServiceQueue& operator=(const ServiceQueue&) = delete;

  /// False if too many calls of `owner` are waiting.
  bool post(const void* owner, std::function<void()> call);

  /// Runs `call` at `due`. Not counted here; the owner limits their number.
  void post_at(const void* owner, Clock::time_point due, std::function<void()> call);

  /// No call of `owner` is running or will run once this has returned, except the calling one.
  void forget(const void* owner);

 private:
  struct Call {
    const void* owner;
    Clock::time_point due;
    bool is_counted;
    std::function<void()> run;
  };
  void add(Call call);
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Call> calls_;
  const void* running_ = nullptr;  // owner of the running call
  bool stopping_ = false;
  std::thread thread_;  // started with the first service
};

}  // namespace panvo::runtime::dds
