// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace panvo::web_view {

/// Carries out requests of one client that wait for nodes, in order, on a thread of its own, which the first starts.
/// Thread-safe.
class SlowRequests {
 public:
  static constexpr std::size_t kMaxWaiting = 64;

  SlowRequests() = default;
  /// Forgets those that wait, and waits for the one that is being carried out.
  ~SlowRequests();
  SlowRequests(const SlowRequests&) = delete;
  SlowRequests& operator=(const SlowRequests&) = delete;

  /// `request` must not throw. Throws ProtocolError if too many wait.
  void add(std::function<void()> request);

 private:
  void loop();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  bool is_ending_ = false;
  std::thread thread_;
};

}  // namespace panvo::web_view
