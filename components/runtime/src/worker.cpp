// SPDX-License-Identifier: Apache-2.0
#include "worker.hpp"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

#include "clocks.hpp"

namespace panvo::runtime {
namespace {

// A tenth of the processor time of a thread that wants the same core: enough to go on where the machine is busy for good.
constexpr int kNiceOfThoseThatGiveWay = 10;

thread_local std::int64_t current_stamp = 0;

/// Linux counts niceness by thread, and lets each make itself nicer.
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

void Worker::push(Port& port, Task task) {
  std::unique_lock lock(mutex_);
  ++port.received;
  if (stopping_ || failed_) {
    ++port.dropped;
    return;
  }
  if (replay_) {  // nothing is ever late in replay: all that is queued runs before the next source steps
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
  if (thread_.joinable()) thread_.join();
  if (replay_) replay_->forget(*this);
  std::deque<std::pair<Port*, Task>>
      discarded;  // destroyed outside the lock: the last owner of a message may free much
  const std::lock_guard lock(mutex_);
  for (const auto& entry : tasks_) {
    ++entry.first->dropped;
    entry.first->waiting = 0;
    --*hooks_.in_flight;
  }
  discarded.swap(tasks_);
}

void Worker::loop() {
  std::unique_lock lock(mutex_);
  while (true) {
    work_or_stop_.wait(lock, [this] { return stopping_ || !tasks_.empty(); });
    if (stopping_) return;
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
    if (tasks_.empty()) return;  // discarded since it was pushed
    entry = std::move(tasks_.front());
    tasks_.pop_front();
    --entry.first->waiting;
  }
  run(*entry.first, entry.second);
  --*hooks_.in_flight;
}

void Worker::run(Port& port, Task& task) {
  if (failed_) return;
  set_current_stamp_ns(task.stamp_ns);
  std::uint64_t undecodable = 0;
  try {
    const StageTimer timer(times_, port.name);
    port.run(task);
  } catch (const interfaces::DecodeError&) {
    undecodable = 1;  // another process sent rubbish: its fault, not this component's
  } catch (const std::exception& error) {
    failed_ = true;
    hooks_.failed(error.what());
  } catch (...) {
    failed_ = true;
    hooks_.failed("an exception that is no std::exception");
  }
  const std::lock_guard lock(mutex_);
  ++port.handled;
  port.undecodable += undecodable;
  if (task.queued_ns != 0) port.latency.add(clocks::monotonic_ns() - task.queued_ns);
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
