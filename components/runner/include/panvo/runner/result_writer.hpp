// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "panvo/runner/run_files.hpp"
#include "panvo/runtime/container.hpp"

namespace panvo::runner {

/// Counts the stereo frames and poses of a container and, with `files`, writes its results. A thread of its own writes,
/// so that publishers do not wait for the disk. Messages are never left out: while `kCapacity` of them wait, publishers
/// wait, too. Create it before the container, whose components may publish until they are destroyed.
class ResultWriter {
 public:
  static constexpr std::size_t kCapacity = 1000;  ///< waiting messages; landmarks, the largest, have about 70 kB

  /// `files` may be nullptr. `failed(problem)` is called once, on the writer's thread, if a file cannot be written;
  /// later messages are discarded.
  ResultWriter(RunFiles* files, std::function<void(const std::string&)> failed);
  ~ResultWriter();

  void observe(runtime::Container& container);
  /// Adds a published message. Thread-safe.
  void add(const runtime::TopicDescription& topic, const runtime::SamplePtr& sample);
  /// Writes all waiting messages and ends the thread. Later messages are discarded.
  void finish();

  std::uint64_t frames_in() const { return frames_in_; }    ///< left images
  std::uint64_t frames_out() const { return frames_out_; }  ///< poses of the stereo odometry
  std::uint64_t frames_unreliable() const { return frames_unreliable_; }

 private:
  using Waiting = std::pair<runtime::TopicDescription, runtime::SamplePtr>;

  void run();
  bool write(const Waiting& message);

  RunFiles* const files_;
  const std::function<void(const std::string&)> failed_;
  std::atomic<std::uint64_t> frames_in_ = 0, frames_out_ = 0, frames_unreliable_ = 0;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Waiting> waiting_;
  bool is_closed_ = false;  // nothing more is taken: finished or failed
  std::thread thread_;      // last: it uses all other members
};

}  // namespace panvo::runner
