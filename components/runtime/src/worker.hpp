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

/// What a worker does again and again.
struct Timer {
  std::int64_t period_ns;
  std::function<void()> run;
  std::optional<std::int64_t>
      due_ns{};  // live by the monotonic clock, in replay by stamps; nothing before time is known
};

/// The order in which replay handles tasks: first in, first out, over all workers. Timers fire when the time of what is handled passes theirs.
class ReplayOrder {
 public:
  explicit ReplayOrder(PassingTime& time) : time_(time) {}

  void push(Worker& worker) { order_.push_back(&worker); }
  /// Runs the oldest task; false when all is quiet.
  bool run_one();
  void add_timer(Worker& worker, Timer& timer) { timers_.emplace_back(&worker, &timer); }
  /// Lets time come to `now_ns`, but fires the timer that is due first on the way; false when none is due any more.
  bool fire_one(std::int64_t now_ns);
  /// Without sources, tasks tell the time: lets it come to a stamp, all timers on the way fired.
  void pass(std::int64_t stamp_ns);
  /// A worker that ends: what waits for it is discarded.
  void forget(const Worker& worker) {
    std::erase(order_, &worker);
    std::erase_if(timers_, [&](const auto& entry) { return entry.first == &worker; });
  }

 private:
  PassingTime& time_;
  std::deque<Worker*> order_;
  std::vector<std::pair<Worker*, Timer*>> timers_;
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

  /// `run` every `period_ns` on the thread that handles the tasks, between two of them: live by the monotonic clock, what was missed left
  /// out; in replay by the stamps of what is handled. Before start().
  void add_timer(std::int64_t period_ns, std::function<void()> run);

  /// `gives_way`: its thread, to others that want the same core.
  void start(bool gives_way = false);
  /// Ends the thread after the task it is at; what still waits is discarded. Releases whoever waits for room.
  void stop();
  /// Replay: runs the oldest task.
  void run_one();
  /// Replay: a timer is due.
  void run_timer(Timer& timer);

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
  /// False where other processes' bytes could not be read. What else is thrown ends the worker.
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
  std::vector<std::unique_ptr<Timer>> timers_;  // of this worker's thread alone once it runs
  bool stopping_ = false;
  std::atomic<bool> failed_ = false;
  std::thread thread_;
};

/// The stamp of what this thread is processing, ns.
std::int64_t current_stamp_ns() noexcept;
void set_current_stamp_ns(std::int64_t stamp_ns) noexcept;

}  // namespace panvo::runtime
