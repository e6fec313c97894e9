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
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/stage_times.hpp"
#include "passing_time.hpp"

namespace panvo::runtime {

class Worker;
class ReplayOrder;

/// A queued task: a message, a pair of messages, or an item of a second stage.
struct Task {
  const TopicDescription* topic = nullptr;
  SamplePtr first{}, second{};
  std::any item{};
  std::int64_t stamp_ns = 0;   // now_ns() during the task
  std::int64_t queued_ns = 0;  // monotonic, live only
};

/// An entrance to a worker's queue: its callback, capacity and counters.
struct Port {
  std::string name;       // stage name in the timing: the topic's name
  std::size_t depth = 1;  // the newest `depth` tasks are kept
  bool waits = false;     // push() blocks when full instead of dropping the oldest
  std::function<void(Task&)> run;
  bool completes = false;  // live, stop() handles its waiting tasks

  // Guarded by the worker's mutex.
  std::size_t waiting = 0;
  std::uint64_t received = 0, handled = 0, dropped = 0, undecodable = 0;
  DurationHistogram latency;  // from queued to handled
};

/// A periodic callback of a worker.
struct Timer {
  std::int64_t period_ns;
  std::function<void()> run;
  std::optional<std::int64_t> due_ns{};  // live: monotonic clock; replay: stamps; unset before time is known
};

/// Order of tasks in replay: FIFO over all workers. Timers fire when the time of the handled tasks passes them.
class ReplayOrder {
 public:
  explicit ReplayOrder(PassingTime& time) : time_(time) {}

  void push(Worker& worker) { order_.push_back(&worker); }
  /// Runs the oldest task; false if there is none.
  bool run_one();
  void add_timer(Worker& worker, Timer& timer) { timers_.emplace_back(&worker, &timer); }
  /// Advances time to `now_ns`, or to the first timer due before and fires it; false if no timer is due.
  bool fire_one(std::int64_t now_ns);
  /// Without sources, tasks drive time: advances it to a stamp and fires all timers due before.
  void pass(std::int64_t stamp_ns);
  /// Removes the tasks and timers of a worker that ends.
  void forget(const Worker& worker) {
    std::erase(order_, &worker);
    std::erase_if(timers_, [&](const auto& entry) { return entry.first == &worker; });
  }

 private:
  PassingTime& time_;
  std::deque<Worker*> order_;
  std::vector<std::pair<Worker*, Timer*>> timers_;
};

/// A bounded queue and its consumer: its own thread (live), or the caller of ReplayOrder::run_one (replay). Tasks run
/// one at a time in order of arrival. An exception stops the worker, not the process: it is reported, and further tasks
/// are discarded.
class Worker {
 public:
  struct Hooks {
    std::function<void(const std::string& what)> failed;
    std::function<void()> progressed;                // a task was handled; wakes waiting sources
    std::atomic<std::int64_t>* in_flight = nullptr;  // queued or running tasks of all workers; 0 if idle
  };

  /// `replay` is nullptr for a live worker.
  Worker(std::string name, StageTimes& times, ReplayOrder* replay, Hooks hooks);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  Port& add_port(std::string name, std::size_t depth, bool waits, std::function<void(Task&)> run);
  void push(Port& port, Task task);

  /// Calls `run` every `period_ns` on the worker's thread, between two tasks. Live: monotonic clock, missed ticks
  /// skipped; replay: stamps of the handled tasks. Call before start().
  void add_timer(std::int64_t period_ns, std::function<void()> run);

  /// `gives_way`: runs at low priority.
  void start(bool gives_way = false);
  /// Ends the thread after the current task and discards waiting tasks, except those of ports that complete: the caller
  /// handles them. Unblocks waiting push() calls.
  void stop();
  /// Replay: runs the oldest task.
  void run_one();
  /// Replay: a timer is due.
  void run_timer(Timer& timer);

  /// Whether no task is waiting. If sources step only then, no queue overflows: each worker on the way holds at most
  /// one more task, or, after a clock was set, those that waited for it (see StampGate).
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
  /// Counts a message dropped before it was queued: without a partner, or undecodable.
  void count_dropped(Port& port);

 private:
  void loop();
  void run(Port& port, Task& task);
  /// False if received bytes could not be decoded. Other exceptions stop the worker.
  bool attempt(const std::function<void()>& call);
  Timer* next_timer();

  std::string name_;
  StageTimes& times_;
  ReplayOrder* replay_;
  Hooks hooks_;
  mutable std::mutex mutex_;
  std::condition_variable work_or_stop_, room_or_stop_;
  std::deque<std::pair<Port*, Task>> tasks_;
  std::vector<std::unique_ptr<Port>> ports_;
  std::vector<std::unique_ptr<Timer>> timers_;  // used only by the worker's thread once started
  bool stopping_ = false;
  std::atomic<bool> failed_ = false;
  std::thread thread_;
};

/// Stamp of the message this thread is processing, ns.
std::int64_t current_stamp_ns() noexcept;
void set_current_stamp_ns(std::int64_t stamp_ns) noexcept;

}  // namespace panvo::runtime
