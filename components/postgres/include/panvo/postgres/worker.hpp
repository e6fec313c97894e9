// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

namespace panvo::postgres {

/// Pause before the next attempt to reach a server: doubles from 0.25 s up to 30 s. `attempt` counts from 0.
int backoff_ms(int attempt) noexcept;

/// Sleeps for backoff_ms and returns true; false, at once, from the `most`-th attempt on.
bool sleep_before_attempt(int attempt, int most);

/// A thread that works for one that must not wait for a server.
class Worker {
 public:
  /// Runs `step` on the thread after each wake(), again while it returns true. It must not throw.
  explicit Worker(std::function<bool()> step);
  /// finish(0).
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Runs `action` under a lock that both threads use for what they share. It must not wait, nor call the worker.
  void locked(const std::function<void()>& action) const;
  void wake();
  /// For `step`: waits, but not beyond the end of finish(). Returns false if the worker ends.
  bool pause(int wait_ms);
  /// Waits until nothing is left to do, for `limit_ms` at most, then ends the thread, after what it waits for has its own
  /// limit. Returns whether nothing was left.
  bool finish(int limit_ms);

 private:
  struct Shared;
  std::unique_ptr<Shared> shared_;
};

}  // namespace panvo::postgres
