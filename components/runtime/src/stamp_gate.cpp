// SPDX-License-Identifier: Apache-2.0
#include "stamp_gate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "clocks.hpp"

namespace panvo::runtime {
namespace {

using Outcome = StampGuard::Outcome;

/// nullopt for messages whose stamp is not the time of sending: unstamped, latched, or about the past.
std::optional<std::int64_t> stamp_to_check(const TopicDescription& topic, const Sample& sample) {
  if (!sample.type() || !sample.type()->is_stamped_when_sent) return std::nullopt;
  if (topic.qos.durability == interfaces::Durability::kTransientLocal) return std::nullopt;
  const void* const message = sample.message();
  const auto stamp_ns = message ? sample.type()->stamp_ns(message) : std::nullopt;
  return stamp_ns == 0 ? std::nullopt : stamp_ns;
}

double off_s(const StampGuard::Verdict& verdict) { return 1e-9 * static_cast<double>(verdict.off_ns); }

}  // namespace

void StampGate::add(const TopicDescription& topic, const SamplePtr& sample) {
  const auto arrival_ns = state_.host.time.arrival_ns();
  const auto stamp_ns = arrival_ns ? stamp_to_check(topic, *sample) : std::nullopt;
  if (!stamp_ns) return take_(sample);
  const bool is_of_now = state_.host.time.pace() == PassingTime::Pace::kClock;
  StampGuard::Verdict verdict;
  std::vector<Held> dropped;
  {
    const std::lock_guard lock(mutex_);
    if (!state_.active) return;  // since the caller asked: nothing may wait after drop_waiting()
    verdict = state_.stamp_guard.check(input_, *stamp_ns, *arrival_ns,
                                       is_of_now ? std::optional(clocks::system_ns()) : std::nullopt);
    dropped = pass(topic.name, sample, verdict);
  }
  tell(dropped);
  if (verdict.outcome != Outcome::kClockStep) return;
  state_.logger.warn("{}: its sender's clock changed by {:+.3f} s; messages of the new time are accepted", topic.name,
                     off_s(verdict));
}

void StampGate::drop_waiting() {
  std::vector<Held> dropped;
  {
    const std::lock_guard lock(mutex_);
    dropped.swap(held_);
  }
  tell(dropped);
}

std::vector<StampGate::Held> StampGate::pass(const std::string& topic, const SamplePtr& sample,
                                             const StampGuard::Verdict& verdict) {
  const auto kept = std::min(held_.size(), static_cast<std::size_t>(verdict.agreeing));
  const auto first = held_.end() - static_cast<std::ptrdiff_t>(kept);
  std::vector<Held> dropped(std::make_move_iterator(held_.begin()), std::make_move_iterator(first));
  held_.erase(held_.begin(), first);
  if (verdict.outcome == Outcome::kSuspected) {
    held_.push_back({topic, sample, verdict});
    return dropped;
  }
  for (const auto& held : held_) take_(held.sample);
  held_.clear();
  take_(sample);
  return dropped;
}

void StampGate::tell(const std::vector<Held>& dropped) {
  for (const auto& [topic, sample, verdict] : dropped) {
    state_.rejections.add(topic, verdict.reason);
    state_.logger.warn_throttled(fmt::format("{} {}", topic, verdict.reason),
                                 "{}: dropped a message with {}, by {:+.3f} s: set the clock of its sender", topic,
                                 verdict.reason, off_s(verdict));
  }
}

}  // namespace panvo::runtime
