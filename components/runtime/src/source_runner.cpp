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

SourceRunner::SourceRunner(std::vector<Source*> sources, Settings settings)
    : sources_(std::move(sources)), settings_(std::move(settings)) {}

void SourceRunner::start() {
  first_stamp_ns_ = std::numeric_limits<std::int64_t>::max();
  for (Source* source : sources_) next_stamp_ns_.push_back(source->next_stamp_ns().value_or(kAtEnd));
  first_stamp_ns_ = sources_.empty() ? 0 : *std::min_element(next_stamp_ns_.begin(), next_stamp_ns_.end());
  start_ns_ = clocks::monotonic_ns();
  playing_ = sources_.size();
  for (std::size_t index = 0; index < sources_.size(); ++index) threads_.emplace_back([this, index] { play(index); });
}

void SourceRunner::play(std::size_t index) {
  Source& source = *sources_[index];
  try {
    while (const auto stamp_ns = source.next_stamp_ns()) {
      if (!wait_for_turn(index, *stamp_ns)) break;
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
    next_stamp_ns_[index] = kAtEnd;
    --playing_;
  }
  changed_.notify_all();
}

bool SourceRunner::wait_for_turn(std::size_t index, std::int64_t stamp_ns) {
  using std::chrono::steady_clock;
  std::unique_lock lock(mutex_);
  next_stamp_ns_[index] = stamp_ns;
  changed_.notify_all();  // another source may be waiting for this one
  if (settings_.rate > 0) {
    const auto offset_ns = static_cast<std::int64_t>(static_cast<double>(stamp_ns - first_stamp_ns_) / settings_.rate);
    const steady_clock::time_point due{std::chrono::nanoseconds(start_ns_ + offset_ns)};
    changed_.wait_until(lock, due, [&] { return stopping_ || steady_clock::now() >= due; });
  } else {
    while (!changed_.wait_for(lock, std::chrono::seconds(10), [&] {
      const bool is_earliest = stamp_ns <= *std::min_element(next_stamp_ns_.begin(), next_stamp_ns_.end());
      return stopping_ || (is_earliest && settings_.queues_are_empty());
    })) {
      lock.unlock();
      settings_.warn("no message was handled for 10 s; a component is busy with one message, or stuck");
      lock.lock();
    }
  }
  return !stopping_;
}

bool SourceRunner::wait(int limit_ms) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, std::chrono::milliseconds(limit_ms), [&] { return playing_ == 0 || stopping_; }) &&
         playing_ == 0;
}

bool SourceRunner::is_playing() const {
  const std::lock_guard lock(mutex_);
  return playing_ != 0;
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
