// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include "panvo/interfaces/node_topics.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "clocks.hpp"
#include "container_implementation.hpp"

namespace panvo::runtime {

void Container::Implementation::start() {
  const std::lock_guard change(change_mutex_);
  if (started_) return;
  started_ = true;
  const bool plays = std::any_of(entries_.begin(), entries_.end(),
                                 [](const auto& entry) { return entry->context->state().source != nullptr; });
  if (plays) time_.follow_sources();
  for (const auto& entry : entries_) entry->context->state().start();
  tell_nodes();  // some now read /clock
  if (!options_.replay) housekeeping_ = std::thread([this] { keep_house(); });
}

std::vector<std::string> Container::Implementation::run() {
  start();
  std::vector<Source*> sources;
  {
    const std::lock_guard change(change_mutex_);
    running_ = true;
    for (const auto& entry : entries_) {
      if (Source* source = entry->context->state().source) sources.push_back(source);
    }
  }
  if (options_.replay) {
    replay(sources);
  } else {
    run_live(sources);
  }
  running_ = false;
  stop_housekeeping();  // nothing is restarted from now on: it would have no end
  publish_what_waits();
  std::vector<std::string> problems = source_problems_;
  for (auto& problem : end_components()) problems.push_back(std::move(problem));
  const std::lock_guard change(change_mutex_);
  for (const auto& recipe : unmade_)
    problems.push_back(recipe.description.name + " stopped by an error and could not be restarted, see the log");
  const std::lock_guard lock(entries_mutex_);
  for (const auto& entry : entries_) {
    if (entry->context->state().failed())
      problems.push_back(entry->context->name() + " stopped by an error, see the log");
  }
  return problems;
}

/// Lets components publish what they held back, while the others still receive it.
void Container::Implementation::publish_what_waits() {
  bool is_any = false;
  {
    const std::lock_guard change(change_mutex_);
    for (const auto& entry : entries_) {
      Context::State& state = entry->context->state();
      if (!state.last_port || !state.active) continue;
      state.main_worker().push(*state.last_port, {.stamp_ns = state.timer_stamp_ns()});
      is_any = true;
    }
  }
  if (options_.replay) {
    run_until_quiet();
  } else if (is_any) {
    drain(std::chrono::seconds(2));
  }
}

/// Lets components finish their results, such as a bag; failures are problems of the run.
std::vector<std::string> Container::Implementation::end_components() {
  const std::lock_guard change(change_mutex_);
  for (const auto& entry : entries_) end(entry->context->state());
  return std::exchange(end_problems_, {});
}

/// Requires change_mutex_.
void Container::Implementation::end(Context::State& state) {
  state.stop();
  const auto finish = std::exchange(state.end, nullptr);
  if (!finish) return;
  try {
    finish();
  } catch (const std::exception& error) {
    state.logger.error("{}", error.what());
    end_problems_.push_back(state.description.name + ": " + error.what());
  }
}

/// Stops a component for good and lets it finish its results; its node and services stay until it is unloaded.
void Container::Implementation::finalize(std::uint64_t id) {
  const std::lock_guard change(change_mutex_);
  const auto found = std::ranges::find(entries_, id, [](const auto& entry) { return entry->recipe.id; });
  if (found == entries_.end()) return;
  end((*found)->context->state());
  tell_nodes();
}

void Container::Implementation::request_stop() noexcept {
  stop_requested_ = true;
  stop_changed_.notify_all();
}

void Container::Implementation::run_until_quiet() {
  while (replay_order_.run_one()) {
  }
}

void Container::Implementation::progressed() {
  if (SourceRunner* runner = active_runner_.load()) runner->wake();
  stop_changed_.notify_all();
}

/// The source with the earliest stamp steps, then all resulting tasks are handled in FIFO order.
void Container::Implementation::replay(const std::vector<Source*>& sources) {
  std::int64_t shown_ns = 0;
  run_until_quiet();
  while (true) {
    Source* earliest = nullptr;
    std::int64_t earliest_ns = 0;
    for (Source* source : sources) {
      const auto stamp_ns = source->next_stamp_ns();
      if (stamp_ns && (!earliest || *stamp_ns < earliest_ns)) {
        earliest = source;
        earliest_ns = *stamp_ns;
      }
    }
    if (!earliest) break;
    was_interrupted_ = stop_requested_;
    if (was_interrupted_) break;
    while (replay_order_.fire_one(earliest_ns)) run_until_quiet();
    set_current_stamp_ns(earliest_ns);
    host_.pacer.reach(earliest_ns);
    try {
      earliest->emit();
    } catch (const std::exception& error) {
      fail_source(error.what());
      break;
    }
    ++source_steps_;
    run_until_quiet();
    if (const std::int64_t now_ns = clocks::monotonic_ns(); now_ns - shown_ns > 250'000'000) {
      shown_ns = now_ns;
      on_progress(earliest->progress());
    }
  }
}

void Container::Implementation::run_live(const std::vector<Source*>& sources) {
  if (!sources.empty()) open_clock();
  runner_ = std::make_unique<SourceRunner>(
      sources, host_.pacer,
      SourceRunner::Settings{.queues_are_empty = [this] { return queues_are_empty(); },
                             .moved =
                                 [this] {
                                   if (clock_) clock_->restart();
                                 },
                             .reached =
                                 [this](std::int64_t stamp_ns) {
                                   time_.reach(stamp_ns);
                                   host_.pacer.reach(stamp_ns);
                                   if (clock_) clock_->reach(stamp_ns);
                                 },
                             .failed = [this](const std::string& what) { fail_source(what); },
                             .warn = [this](const std::string& text) { log(LogLevel::kWarning, "container", text); }});
  active_runner_ = runner_.get();
  runner_->start();
  if (sources.empty()) {
    std::unique_lock lock(stop_mutex_);
    while (!stop_requested_ && !are_all_lost()) stop_changed_.wait_for(lock, std::chrono::milliseconds(100));
  }
  while (!sources.empty() && !stop_requested_ && !runner_->wait(250)) on_progress(runner_->progress());
  was_interrupted_ = !sources.empty() && runner_->is_playing();
  runner_->stop();
  drain(std::chrono::seconds(10));
  source_steps_ += runner_->steps();
  if (!sources.empty()) on_progress(runner_->progress());
}

/// Publishes /clock if sources play at a fixed rate, unless a component publishes it.
void Container::Implementation::open_clock() {
  if (!bus_.bridge() || options_.rate <= 0) return;
  for (const Channel* channel : bus_.channels()) {
    if (channel->topic().name == topics::kClock.name && channel->has_publisher_other_than(nullptr)) return;
  }
  {
    const std::lock_guard lock(entries_mutex_);
    clock_ = std::make_unique<PlayedClock>(*bus_.bridge());
  }
  tell_nodes();
}

/// Waits until queued messages are handled and sent messages acknowledged. Gives up after so long without progress, or
/// in total when stopped, as other processes may keep sending.
void Container::Implementation::drain(std::chrono::seconds patience) {
  using std::chrono::steady_clock;
  std::unique_lock lock(stop_mutex_);
  std::int64_t before = host_.in_flight;
  auto give_up = steady_clock::now() + patience;
  while (host_.in_flight != 0 && steady_clock::now() < give_up) {
    stop_changed_.wait_for(lock, std::chrono::milliseconds(20));
    if (host_.in_flight != before && !stop_requested_) give_up = steady_clock::now() + patience;
    before = host_.in_flight;
  }
  lock.unlock();
  if (before != 0)
    log(LogLevel::kWarning, "container", fmt::format("{} messages were still waiting at the end", before));
  if (!bus_.wait_for_acknowledgments(std::min(patience, std::chrono::seconds(3)))) {
    log(LogLevel::kWarning, "container", "another process has not acknowledged all messages");
  }
}

bool Container::Implementation::queues_are_empty() {
  const std::lock_guard lock(entries_mutex_);
  for (const auto& entry : entries_) {
    for (const auto& worker : entry->context->state().workers) {
      if (!worker->queue_is_empty()) return false;
    }
  }
  return true;
}

void Container::Implementation::fail_source(const std::string& what) {
  log(LogLevel::kError, "container", what);
  const std::lock_guard lock(stop_mutex_);
  source_problems_.push_back(what);
}

}  // namespace panvo::runtime
