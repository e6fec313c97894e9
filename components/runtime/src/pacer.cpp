// SPDX-License-Identifier: Apache-2.0
#include "pacer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "clocks.hpp"

namespace panvo::runtime {
namespace {

/// Up to a century: clients may ask for any rate, and integers do not hold more than three.
std::int64_t bounded(double duration_ns) {
  constexpr double kCentury_ns = 3.2e18;
  return static_cast<std::int64_t>(std::clamp(duration_ns, -kCentury_ns, kCentury_ns));
}

}  // namespace

std::int64_t Pacer::State::due_ns(std::int64_t stamp) const {
  return since_ns + bounded(static_cast<double>(stamp - stamp_ns) / rate);
}

void Pacer::start(std::int64_t first_stamp_ns, std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  state_.stamp_ns = first_stamp_ns;
  state_.since_ns = now_ns;
  ++state_.version;
}

void Pacer::on_change(std::function<void()> changed, std::function<void()> moved) {
  const std::lock_guard lock(telling_mutex_);
  changed_ = std::move(changed);
  moved_ = std::move(moved);
}

std::optional<std::int64_t> Pacer::stamp_ns() const {
  const std::int64_t reached_ns = reached_ns_;
  return reached_ns == kNever ? std::nullopt : std::optional(reached_ns);
}

Pacer::State Pacer::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void Pacer::go_on_from_here() {
  const std::int64_t now_ns = clocks::monotonic_ns();
  if (!state_.is_paused) {
    const std::int64_t played_ns = bounded(static_cast<double>(now_ns - state_.since_ns) * state_.rate);
    state_.stamp_ns += std::min(played_ns, INT64_MAX - std::max<std::int64_t>(state_.stamp_ns, 0));
  }
  state_.since_ns = now_ns;
  ++state_.version;
}

void Pacer::set_paused(bool is_paused) {
  {
    const std::lock_guard lock(mutex_);
    if (state_.is_paused == is_paused) return;
    go_on_from_here();
    state_.is_paused = is_paused;
  }
  tell(false);
}

bool Pacer::set_rate(double rate) {
  {
    const std::lock_guard lock(mutex_);
    if (state_.rate <= 0 || rate <= 0 || !std::isfinite(rate)) return false;
    go_on_from_here();
    state_.rate = rate;
  }
  tell(false);
  return true;
}

void Pacer::add(Source& source) {
  const std::lock_guard lock(sources_mutex_);
  sources_.push_back(&source);
}

void Pacer::remove(Source& source) {
  const std::lock_guard lock(sources_mutex_);
  std::erase(sources_, &source);
}

std::optional<StampRange> Pacer::range() const {
  const std::lock_guard lock(sources_mutex_);
  return range_of_sources();
}

std::optional<StampRange> Pacer::range_of_sources() const {
  std::optional<StampRange> whole;
  for (const Source* source : sources_) {
    const auto range = source->range();
    if (!range) continue;
    if (!whole) whole = range;
    whole->first_ns = std::min(whole->first_ns, range->first_ns);
    whole->last_ns = std::max(whole->last_ns, range->last_ns);
  }
  return whole;
}

bool Pacer::seek(std::int64_t stamp_ns) {
  const std::lock_guard one_at_a_time(seeking_mutex_);
  std::int64_t to_ns = stamp_ns;
  {
    const std::lock_guard lock(sources_mutex_);
    const auto range = range_of_sources();
    if (!range) return false;
    to_ns = std::clamp(stamp_ns, range->first_ns, range->last_ns);
    for (Source* source : sources_) {
      if (source->range()) source->seek(to_ns);
    }
  }
  move_to(to_ns);
  return true;
}

void Pacer::move_to(std::int64_t stamp_ns) {
  {
    const std::lock_guard lock(mutex_);
    state_.stamp_ns = stamp_ns;
    state_.since_ns = clocks::monotonic_ns();
    ++state_.version;
    reached_ns_ = stamp_ns;  // while paused, no step updates it
    is_at_end_ = false;
  }
  tell(true);
}

void Pacer::tell(bool is_move) {
  const std::lock_guard lock(telling_mutex_);
  if (is_move) moved_();
  changed_();
}

}  // namespace panvo::runtime
