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

#include "pacer.hpp"
#include "panvo/runtime/source.hpp"

namespace panvo::runtime {

/// Runs sources live, each on its own thread: at the recorded rate, scaled, or whenever all queues are empty.
class SourceRunner {
 public:
  struct Settings {
    std::function<bool()> queues_are_empty;
    std::function<void()> moved = [] {};                              // after a source was moved
    std::function<void(std::int64_t)> reached = [](std::int64_t) {};  // called with the stamp of a source's next step
    std::function<void(const std::string&)> failed;
    std::function<void(const std::string&)> warn;
  };

  /// `pacer` must outlive it.
  SourceRunner(std::vector<Source*> sources, Pacer& pacer, Settings settings);
  ~SourceRunner() { stop(); }

  void start();
  /// Waits until all sources have ended, stop() is called or `limit_ms` has passed; true if they have ended.
  bool wait(int limit_ms);
  /// Whether a source has not reached its end.
  bool is_playing() const;
  void stop();

  /// Call after a worker has handled a task or when the container is to stop: waiting sources check again.
  void wake();

  Source::Progress progress() const;
  std::uint64_t steps() const noexcept { return steps_; }

 private:
  void play(std::size_t index);
  enum class Turn { kStep, kAskAgain, kStop };
  /// `stamp_ns`: of the source's next step, asked for at that version of the pace.
  Turn wait_for_turn(std::size_t index, std::int64_t stamp_ns, std::uint64_t version);
  void set_next(std::size_t index, std::int64_t stamp_ns);
  bool is_due(std::int64_t stamp_ns, const Pacer::State& pace) const;
  void wait_for_change(std::unique_lock<std::mutex>& lock, std::int64_t stamp_ns, const Pacer::State& pace);

  const std::vector<Source*> sources_;
  Pacer& pacer_;
  const Settings settings_;
  mutable std::mutex mutex_;
  std::vector<std::int64_t> next_stamp_ns_;  // per source: at full speed the earliest steps first
  std::condition_variable changed_;
  std::size_t playing_ = 0;
  bool stopping_ = false;
  Source::Progress progress_;
  std::atomic<std::uint64_t> steps_ = 0;
  std::vector<std::thread> threads_;
};

}  // namespace panvo::runtime
