// SPDX-License-Identifier: Apache-2.0
#include "source_runner.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "clocks.hpp"
#include "worker.hpp"

namespace panvo::runtime {
namespace {

constexpr std::int64_t kAtEnd = std::numeric_limits<std::int64_t>::max();

}  // namespace

SourceRunner::SourceRunner(std::vector<Source*> sources, Pacer& pacer, Settings settings)
    : sources_(std::move(sources)), pacer_(pacer), settings_(std::move(settings)) {
  pacer_.on_change([this] { wake(); }, settings_.moved);
}

void SourceRunner::start() {
  for (Source* source : sources_) next_stamp_ns_.push_back(source->next_stamp_ns().value_or(kAtEnd));
  pacer_.start(sources_.empty() ? 0 : *std::min_element(next_stamp_ns_.begin(), next_stamp_ns_.end()),
               clocks::monotonic_ns());
  playing_ = sources_.size();
  for (std::size_t index = 0; index < sources_.size(); ++index) threads_.emplace_back([this, index] { play(index); });
}

void SourceRunner::play(std::size_t index) {
  Source& source = *sources_[index];
  try {
    while (true) {
      const auto version = pacer_.state().version;
      const auto stamp_ns = source.next_stamp_ns();
      if (!stamp_ns && !source.waits_at_end()) break;
      const Turn turn = wait_for_turn(index, stamp_ns.value_or(kAtEnd), version);
      if (turn == Turn::kStop) break;
      if (turn == Turn::kAskAgain) continue;
      set_current_stamp_ns(*stamp_ns);
      settings_.reached(*stamp_ns);
      source.emit();
      ++steps_;
      const std::lock_guard lock(mutex_);
      progress_ = source.progress();
    }
  } catch (const std::exception& error) {
    settings_.failed(error.what());
  }
  {
    const std::lock_guard lock(mutex_);
    set_next(index, kAtEnd);
    --playing_;
  }
  changed_.notify_all();
}

SourceRunner::Turn SourceRunner::wait_for_turn(std::size_t index, std::int64_t stamp_ns, std::uint64_t version) {
  std::unique_lock lock(mutex_);
  set_next(index, stamp_ns);
  changed_.notify_all();  // another source may be waiting for this one
  while (!stopping_) {
    const auto pace = pacer_.state();
    if (pace.version != version) return Turn::kAskAgain;
    if (is_due(stamp_ns, pace)) return Turn::kStep;
    wait_for_change(lock, stamp_ns, pace);
  }
  return Turn::kStop;
}

/// Requires mutex_.
void SourceRunner::set_next(std::size_t index, std::int64_t stamp_ns) {
  next_stamp_ns_[index] = stamp_ns;
  pacer_.set_at_end(std::ranges::all_of(next_stamp_ns_, [](std::int64_t next_ns) { return next_ns == kAtEnd; }));
}

/// Requires mutex_.
bool SourceRunner::is_due(std::int64_t stamp_ns, const Pacer::State& pace) const {
  if (stamp_ns == kAtEnd || pace.is_paused) return false;
  if (pace.rate > 0) return clocks::monotonic_ns() >= pace.due_ns(stamp_ns);
  return stamp_ns <= *std::min_element(next_stamp_ns_.begin(), next_stamp_ns_.end()) && settings_.queues_are_empty();
}

void SourceRunner::wait_for_change(std::unique_lock<std::mutex>& lock, std::int64_t stamp_ns,
                                   const Pacer::State& pace) {
  if (stamp_ns == kAtEnd || pace.is_paused) {
    changed_.wait(lock);
  } else if (pace.rate > 0) {
    changed_.wait_until(lock, std::chrono::steady_clock::time_point(std::chrono::nanoseconds(pace.due_ns(stamp_ns))));
  } else if (changed_.wait_for(lock, std::chrono::seconds(10)) == std::cv_status::timeout) {
    lock.unlock();
    settings_.warn("no message was handled for 10 s; a component is busy with one message, or stuck");
    lock.lock();
  }
}

bool SourceRunner::wait(int limit_ms) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, std::chrono::milliseconds(limit_ms), [&] { return playing_ == 0 || stopping_; }) &&
         playing_ == 0;
}

bool SourceRunner::is_playing() const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(next_stamp_ns_, [](std::int64_t stamp_ns) { return stamp_ns != kAtEnd; });
}

void SourceRunner::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  for (auto& thread : threads_) thread.join();
  threads_.clear();
}

void SourceRunner::wake() {
  { const std::lock_guard lock(mutex_); }  // ensures that a source about to wait is already waiting
  changed_.notify_all();
}

Source::Progress SourceRunner::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

}  // namespace panvo::runtime
