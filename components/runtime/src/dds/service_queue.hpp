// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace panvo::runtime::dds {

/// The thread on which the services of a bridge answer, and what waits for it. Safe to use from several
/// threads.
class ServiceQueue {
 public:
  /// Of one service; DDS holds ten more for it, so that a client must be in quite a hurry to lose a request.
  static constexpr std::size_t kMaxWaiting = 32;
  using Clock = std::chrono::steady_clock;

  ServiceQueue() = default;
  ~ServiceQueue();
  ServiceQueue(const ServiceQueue&) = delete;
  ServiceQueue& operator=(const ServiceQueue&) = delete;

  /// False when too many of `owner`'s wait.
  bool post(const void* owner, std::function<void()> call);

  /// Runs `call` at `due`. The owner bounds how many of these wait; they are not counted here.
  void post_at(const void* owner, Clock::time_point due, std::function<void()> call);

  /// When this returns, nothing of `owner`'s runs or will; except the call that asks for it.
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
  const void* running_ = nullptr;  // whose call is
  bool stopping_ = false;
  std::thread thread_;  // started by the first service
};

}  // namespace panvo::runtime::dds
