// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <any>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/stage_times.hpp"

namespace panvo::runtime {

class Worker;
class ReplayOrder;

/// What waits for a worker: a message, two of a pair, or an item for a second stage.
struct Task {
  const TopicDescription* topic = nullptr;
  SamplePtr first{}, second{};
  std::any item{};
  std::int64_t stamp_ns = 0;   // what now_ns() is meanwhile
  std::int64_t queued_ns = 0;  // monotonic, live only
};

/// One way into a worker's queue: what to call, how many tasks may wait, and what became of them.
struct Port {
  std::string name;       // of the stage in the times: the topic's name
  std::size_t depth = 1;  // of those that wait, the newest `depth` are kept
  bool waits = false;     // instead of dropping the oldest, whoever pushes waits for room
  std::function<void(Task&)> run;

  // Guarded by the worker's mutex.
  std::size_t waiting = 0;
  std::uint64_t received = 0, handled = 0, dropped = 0, undecodable = 0;
  DurationHistogram latency;  // from queued to handled
};

/// The order in which replay handles tasks: first in, first out, over all workers.
class ReplayOrder {
 public:
  void push(Worker& worker) { order_.push_back(&worker); }
  /// Runs the oldest task; false when all is quiet.
  bool run_one();
  /// A worker that ends: what waits for it is discarded.
  void forget(const Worker& worker) { std::erase(order_, &worker); }

 private:
  std::deque<Worker*> order_;
};

/// A bounded queue and who empties it: live a thread of its own, in replay the caller of ReplayOrder::run_one. Tasks run one at a time, in
/// the order they came. What a task throws ends the worker, not the process: it is reported, and further tasks are discarded.
class Worker {
 public:
  struct Hooks {
    std::function<void(const std::string& what)> failed;
    std::function<void()> progressed;                // a task was handled: for those who wait for room
    std::atomic<std::int64_t>* in_flight = nullptr;  // tasks queued or running, over all workers: 0 when all is quiet
  };

  /// `replay` is nullptr for a live worker.
  Worker(std::string name, StageTimes& times, ReplayOrder* replay, Hooks hooks);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  Port& add_port(std::string name, std::size_t depth, bool waits, std::function<void(Task&)> run);
  void push(Port& port, Task task);

  /// `gives_way`: its thread, to others that want the same core.
  void start(bool gives_way = false);
  /// Ends the thread after the task it is at; what still waits is discarded. Releases whoever waits for room.
  void stop();
  /// Replay: runs the oldest task.
  void run_one();

  /// Whether nothing waits. A source that steps only then can never make a queue overflow: each worker on the way holds at most one task more.
  bool queue_is_empty() const;
  bool failed() const noexcept { return failed_; }

  const std::string& name() const noexcept { return name_; }
  struct PortCounters {
    std::string input;
    std::size_t waiting;
    std::uint64_t received, handled, dropped, undecodable;
    DurationHistogram latency;
  };
  std::vector<PortCounters> counters() const;
  /// Counts a message that was given up before it could be queued: without a partner, or not decodable.
  void count_dropped(Port& port);

 private:
  void loop();
  void run(Port& port, Task& task);

  std::string name_;
  StageTimes& times_;
  ReplayOrder* replay_;
  Hooks hooks_;
  mutable std::mutex mutex_;
  std::condition_variable work_or_stop_, room_or_stop_;
  std::deque<std::pair<Port*, Task>> tasks_;
  std::vector<std::unique_ptr<Port>> ports_;
  bool stopping_ = false;
  std::atomic<bool> failed_ = false;
  std::thread thread_;
};

/// The stamp of what this thread is processing, ns.
std::int64_t current_stamp_ns() noexcept;
void set_current_stamp_ns(std::int64_t stamp_ns) noexcept;

}  // namespace panvo::runtime
