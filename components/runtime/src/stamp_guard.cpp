// SPDX-License-Identifier: Apache-2.0
#include "stamp_guard.hpp"

#include <algorithm>

namespace panvo::runtime {
namespace {

constexpr std::int64_t kLate_ns = 5'000'000'000;  // largest delay of messages derived from another message
constexpr std::int64_t kSlower =
    50;  // fraction (1 / kSlower) of a later arrival that is learned: most of the delay is queueing
constexpr std::int64_t kMeanOver = 8;                 // intervals
constexpr std::int64_t kLongest_ns = 60'000'000'000;  // interval; a longer one is a silence, or a clock that was set

constexpr std::string_view kAheadOfHost = "a stamp ahead of this host's clock";
constexpr std::string_view kAhead = "a stamp ahead of its neighbours";
constexpr std::string_view kBack = "a stamp behind its neighbours";

}  // namespace

StampGuard::Verdict StampGuard::check(const std::string& input, std::int64_t stamp_ns, std::int64_t arrival_ns,
                                      std::optional<std::int64_t> host_ns) {
  const std::lock_guard lock(mutex_);
  Topic& own = topics_[input];
  const std::int64_t offset_ns = stamp_ns - arrival_ns;
  Verdict verdict;
  const int agreeing = agreeing_suspects(own, stamp_ns, arrival_ns);
  if (!own.has_any) {
    const bool is_of_now = !host_ns || stamp_ns <= *host_ns + limits_.ahead_ns;
    if (!is_of_now) verdict = {.off_ns = stamp_ns - *host_ns, .reason = kAheadOfHost};
  } else if (stamp_ns < own.stamp_ns - limits_.back_ns) {
    verdict = {.off_ns = stamp_ns - own.stamp_ns, .reason = kBack};
  } else if (offset_ns > own.offset_ns + allowance_ns(own)) {
    // The partner of a message whose clock was just found to be set need not be confirmed, nor need those before it.
    if (agrees_with_another(own, stamp_ns, arrival_ns)) {
      verdict.agreeing = agreeing;
    } else {
      verdict = {.off_ns = offset_ns - own.offset_ns, .reason = kAhead};
    }
  }
  if (verdict.reason.empty()) {
    learn(own, stamp_ns, offset_ns);
  } else {
    verdict.agreeing = agreeing;
    own.suspects = agreeing + 1;
    own.suspect_stamp_ns = stamp_ns;
    own.suspect_arrival_ns = arrival_ns;
    verdict.outcome = own.suspects < limits_.confirmations ? Outcome::kSuspected : Outcome::kClockStep;
    if (verdict.outcome == Outcome::kSuspected) return verdict;
    own.offset_ns = offset_ns;
  }
  own.suspects = 0;
  own.has_any = true;
  own.stamp_ns = stamp_ns;
  own.arrival_ns = arrival_ns;
  return verdict;
}

void StampGuard::learn(Topic& topic, std::int64_t stamp_ns, std::int64_t offset_ns) {
  if (!topic.has_any) {
    topic.offset_ns = offset_ns;
    return;
  }
  const std::int64_t interval_ns = std::clamp<std::int64_t>(stamp_ns - topic.stamp_ns, 0, kLongest_ns);
  topic.interval_ns += topic.interval_ns == 0 ? interval_ns : (interval_ns - topic.interval_ns) / kMeanOver;
  const std::int64_t later_ns = offset_ns - topic.offset_ns;
  topic.offset_ns += later_ns > 0 ? later_ns : later_ns / kSlower;
}

/// Messages played faster than recorded arrive early by almost one interval.
std::int64_t StampGuard::allowance_ns(const Topic& topic) const {
  if (topic.interval_ns == 0) return limits_.max_ahead_ns;
  return std::clamp(topic.interval_ns * 5 / 2, limits_.ahead_ns, limits_.max_ahead_ns);
}

/// A topic with rare messages cannot determine the time offset itself when time runs at another rate.
bool StampGuard::agrees_with_another(const Topic& own, std::int64_t stamp_ns, std::int64_t arrival_ns) const {
  return std::any_of(topics_.begin(), topics_.end(), [&](const auto& entry) {
    const Topic& other = entry.second;
    if (&other == &own || !other.has_any) return false;
    const std::int64_t ahead_ns = stamp_ns - (other.stamp_ns + arrival_ns - other.arrival_ns);
    return ahead_ns <= limits_.ahead_ns && ahead_ns >= -kLate_ns;
  });
}

/// Those that waited in another component come at once: each is then ahead by an interval, however long that is.
int StampGuard::agreeing_suspects(const Topic& topic, std::int64_t stamp_ns, std::int64_t arrival_ns) const {
  const std::int64_t interval_ns = stamp_ns - topic.suspect_stamp_ns;
  const std::int64_t ahead_ns = interval_ns - (arrival_ns - topic.suspect_arrival_ns);
  const std::int64_t most_ns = std::max(allowance_ns(topic), topic.interval_ns * 5 / 4);
  const bool agrees = interval_ns > 0 && ahead_ns <= most_ns;
  return agrees ? topic.suspects : 0;
}

}  // namespace panvo::runtime
