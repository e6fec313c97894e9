// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "panvo/runtime/source.hpp"

namespace panvo::runtime {

/// When sources step, live: a thread for each, at the recorded rate, scaled, or as soon as nothing waits in any queue.
class SourceRunner {
 public:
  struct Settings {
    double rate = 1;  // 0: as fast as the consumers take it
    std::function<bool()> queues_are_empty;
    std::function<void(std::int64_t)> reached = [](std::int64_t) {};  // the stamp of what a source plays next
    std::function<void(const std::string&)> failed;
    std::function<void(const std::string&)> warn;
  };

  SourceRunner(std::vector<Source*> sources, Settings settings);
  ~SourceRunner() { stop(); }

  void start();
  /// Waits until all sources are at their end, or stop() was called, or `limit_ms` has passed; true when they have ended.
  bool wait(int limit_ms);
  /// Whether a source is not at its end.
  bool is_playing() const;
  void stop();

  /// A worker handled a task, or the container is to stop: whoever waits for room looks again.
  void wake();

  Source::Progress progress() const;
  std::uint64_t steps() const noexcept { return steps_; }

 private:
  void play(std::size_t index);
  bool wait_for_turn(std::size_t index, std::int64_t stamp_ns);

  const std::vector<Source*> sources_;
  const Settings settings_;
  std::int64_t first_stamp_ns_ = 0;  // of all sources: they share one time
  std::int64_t start_ns_ = 0;
  mutable std::mutex mutex_;
  std::vector<std::int64_t> next_stamp_ns_;  // of each source: at full speed the earliest goes first
  std::condition_variable changed_;
  std::size_t playing_ = 0;
  bool stopping_ = false;
  Source::Progress progress_;
  std::atomic<std::uint64_t> steps_ = 0;
  std::vector<std::thread> threads_;
};

}  // namespace panvo::runtime
