// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace panvo::runtime::dds {

/// The thread on which the services of a bridge answer, and what waits for it. Safe to use from several
/// threads.
class ServiceQueue {
 public:
  /// Of one service; DDS holds ten more for it, so that a client must be in quite a hurry to lose a request.
  static constexpr std::size_t kMaxWaiting = 32;

  ServiceQueue() = default;
  ~ServiceQueue();
  ServiceQueue(const ServiceQueue&) = delete;
  ServiceQueue& operator=(const ServiceQueue&) = delete;

  /// False when too many of `owner`'s wait.
  bool post(const void* owner, std::function<void()> call);

  /// When this returns, nothing of `owner`'s runs or will; except the call that asks for it.
  void forget(const void* owner);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  struct Call {
    const void* owner;
    std::function<void()> run;
  };
  std::deque<Call> calls_;
  const void* running_ = nullptr;  // whose call is
  bool stopping_ = false;
  std::thread thread_;  // started by the first service
};

}  // namespace panvo::runtime::dds
