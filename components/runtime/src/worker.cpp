// SPDX-License-Identifier: Apache-2.0
#include "worker.hpp"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "clocks.hpp"

namespace panvo::runtime {
namespace {

// About a tenth of the CPU time of a competing thread: enough to progress on a busy machine.
constexpr int kNiceOfThoseThatGiveWay = 10;

constexpr std::int64_t kMaxMissed = 100;  // missed ticks caught up in replay

thread_local std::int64_t current_stamp = 0;

/// On Linux, niceness is per thread, and a thread may raise its own.
void be_nicer() {
  const auto thread = static_cast<id_t>(gettid());
  setpriority(PRIO_PROCESS, thread, getpriority(PRIO_PROCESS, thread) + kNiceOfThoseThatGiveWay);  // 19 at most
}

}  // namespace

std::int64_t current_stamp_ns() noexcept { return current_stamp; }
void set_current_stamp_ns(std::int64_t stamp_ns) noexcept { current_stamp = stamp_ns; }

bool ReplayOrder::run_one() {
  if (order_.empty()) return false;
  Worker& worker = *order_.front();
  order_.pop_front();
  worker.run_one();
  return true;
}

bool ReplayOrder::fire_one(std::int64_t now_ns) {
  std::pair<Worker*, Timer*> first{};
  for (const auto& [worker, timer] : timers_) {
    if (!timer->due_ns) timer->due_ns = now_ns + timer->period_ns;
    // Skips older ticks: a stamp may jump by years.
    timer->due_ns = std::max(*timer->due_ns, now_ns - kMaxMissed * timer->period_ns);
    if (*timer->due_ns > now_ns || (first.second && *first.second->due_ns <= *timer->due_ns)) continue;
    first = {worker, timer};
  }
  if (!first.second) {
    time_.reach(now_ns);
    return false;
  }
  time_.reach(*first.second->due_ns);
  first.second->due_ns = *first.second->due_ns + first.second->period_ns;
  first.first->run_timer(*first.second);
  return true;
}

void ReplayOrder::pass(std::int64_t stamp_ns) {
  if (time_.pace() != PassingTime::Pace::kTasks) return;
  while (fire_one(stamp_ns)) {
  }
}

Worker::Worker(std::string name, StageTimes& times, ReplayOrder* replay, Hooks hooks)
    : name_(std::move(name)), times_(times), replay_(replay), hooks_(std::move(hooks)) {}

Worker::~Worker() { stop(); }

Port& Worker::add_port(std::string name, std::size_t depth, bool waits, std::function<void(Task&)> run) {
  auto port = std::make_unique<Port>();
  port->name = std::move(name);
  port->depth = std::max<std::size_t>(depth, 1);
  port->waits = waits;
  port->run = std::move(run);
  const std::lock_guard lock(mutex_);
  return *ports_.emplace_back(std::move(port));
}

void Worker::add_timer(std::int64_t period_ns, std::function<void()> run) {
  timers_.push_back(std::make_unique<Timer>(Timer{.period_ns = period_ns, .run = std::move(run)}));
  if (replay_) replay_->add_timer(*this, *timers_.back());
}

void Worker::push(Port& port, Task task) {
  std::unique_lock lock(mutex_);
  ++port.received;
  if (stopping_ || failed_) {
    ++port.dropped;
    return;
  }
  if (replay_) {  // replay never drops: the queue is emptied before the next source step
    ++port.waiting;
    ++*hooks_.in_flight;
    tasks_.emplace_back(&port, std::move(task));
    replay_->push(*this);
    return;
  }
  if (port.waits) {
    room_or_stop_.wait(lock, [&] { return port.waiting < port.depth || stopping_ || failed_; });
    if (stopping_ || failed_) {
      ++port.dropped;
      return;
    }
  } else if (port.waiting >= port.depth) {
    const auto oldest =
        std::find_if(tasks_.begin(), tasks_.end(), [&](const auto& entry) { return entry.first == &port; });
    tasks_.erase(oldest);
    --port.waiting;
    ++port.dropped;
    --*hooks_.in_flight;
  }
  ++*hooks_.in_flight;
  task.queued_ns = clocks::monotonic_ns();
  ++port.waiting;
  tasks_.emplace_back(&port, std::move(task));
  lock.unlock();
  work_or_stop_.notify_one();
}

void Worker::start(bool gives_way) {
  if (replay_ || thread_.joinable()) return;
  thread_ = std::thread([this, gives_way] {
    if (gives_way) be_nicer();
    loop();
  });
  pthread_setname_np(thread_.native_handle(), name_.substr(0, 15).c_str());  // 15: the kernel's limit
}

void Worker::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  work_or_stop_.notify_all();
  room_or_stop_.notify_all();
  const bool has_run = thread_.joinable();  // else the component may not even have been constructed
  if (has_run) thread_.join();
  if (replay_) replay_->forget(*this);
  std::deque<std::pair<Port*, Task>> left;  // destroyed outside the lock, as this may free much memory
  {
    const std::lock_guard lock(mutex_);
    left.swap(tasks_);
    for (const auto& [port, task] : left) {
      if (!has_run || !port->completes) ++port->dropped;
      port->waiting = 0;
      --*hooks_.in_flight;
    }
  }
  for (auto& [port, task] : left) {
    if (has_run && port->completes) run(*port, task);
  }
}

void Worker::loop() {
  std::unique_lock lock(mutex_);
  bool is_turn_of_tasks = false;  // tasks wait for at most one timer
  while (true) {
    const auto is_wanted = [this] { return stopping_ || !tasks_.empty(); };
    Timer* const timer = next_timer();
    if (timer && !(is_turn_of_tasks && !tasks_.empty())) {
      const std::chrono::steady_clock::time_point due{std::chrono::nanoseconds(*timer->due_ns)};
      work_or_stop_.wait_until(lock, due, is_wanted);
      if (!stopping_ && clocks::monotonic_ns() >= *timer->due_ns) {
        lock.unlock();
        run_timer(*timer);
        timer->due_ns = std::max(*timer->due_ns, clocks::monotonic_ns() - timer->period_ns) + timer->period_ns;
        lock.lock();
        is_turn_of_tasks = true;
        continue;
      }
      if (!is_wanted()) continue;
    } else if (!timer) {
      work_or_stop_.wait(lock, is_wanted);
    }
    if (stopping_) return;
    is_turn_of_tasks = false;
    auto [port, task] = std::move(tasks_.front());
    tasks_.pop_front();
    --port->waiting;
    lock.unlock();
    room_or_stop_.notify_one();
    run(*port, task);
    task = {};
    --*hooks_.in_flight;
    hooks_.progressed();
    lock.lock();
  }
}

void Worker::run_one() {
  std::pair<Port*, Task> entry;
  {
    const std::lock_guard lock(mutex_);
    if (tasks_.empty()) return;  // discarded in the meantime
    entry = std::move(tasks_.front());
    tasks_.pop_front();
    --entry.first->waiting;
  }
  replay_->pass(entry.second.stamp_ns);
  run(*entry.first, entry.second);
  --*hooks_.in_flight;
}

void Worker::run(Port& port, Task& task) {
  if (failed_) return;
  set_current_stamp_ns(task.stamp_ns);
  const bool is_readable = attempt([&] {
    const StageTimer timer(times_, port.name);
    port.run(task);
  });
  const std::lock_guard lock(mutex_);
  ++port.handled;
  if (!is_readable) ++port.undecodable;
  if (task.queued_ns != 0) port.latency.add(clocks::monotonic_ns() - task.queued_ns);
}

void Worker::run_timer(Timer& timer) {
  if (!failed_) attempt(timer.run);
}

bool Worker::attempt(const std::function<void()>& call) {
  try {
    call();
  } catch (const interfaces::DecodeError&) {
    return false;  // malformed data of another process is not this component's fault
  } catch (const std::exception& error) {
    failed_ = true;
    hooks_.failed(error.what());
  } catch (...) {
    failed_ = true;
    hooks_.failed("an exception not derived from std::exception");
  }
  return true;
}

/// The timer due first; new timers are due after one period.
Timer* Worker::next_timer() {
  Timer* next = nullptr;
  for (const auto& timer : timers_) {
    if (!timer->due_ns) timer->due_ns = clocks::monotonic_ns() + timer->period_ns;
    if (!next || *timer->due_ns < *next->due_ns) next = timer.get();
  }
  return next;
}

bool Worker::queue_is_empty() const {
  const std::lock_guard lock(mutex_);
  return tasks_.empty() || failed_ || stopping_;
}

void Worker::count_dropped(Port& port) {
  const std::lock_guard lock(mutex_);
  ++port.dropped;
}

std::vector<Worker::PortCounters> Worker::counters() const {
  const std::lock_guard lock(mutex_);
  std::vector<PortCounters> counters;
  for (const auto& port : ports_) {
    counters.push_back(
        {port->name, port->waiting, port->received, port->handled, port->dropped, port->undecodable, port->latency});
  }
  return counters;
}

}  // namespace panvo::runtime
