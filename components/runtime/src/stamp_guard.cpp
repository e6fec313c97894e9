// SPDX-License-Identifier: Apache-2.0
#include "stamp_guard.hpp"

#include <algorithm>

namespace panvo::runtime {
namespace {

constexpr std::int64_t kLate_ns = 5'000'000'000;  // largest delay of messages derived from another message
constexpr std::int64_t kReportPeriod_ns = 10'000'000'000;
constexpr std::int64_t kSlower =
    50;  // fraction (1 / kSlower) of a later arrival that is learned: most of the delay is queueing
constexpr std::int64_t kMeanOver = 8;  // intervals

constexpr std::string_view kAheadOfHost = "a stamp ahead of this host's clock";
constexpr std::string_view kAhead = "a stamp ahead of its neighbours";
constexpr std::string_view kBack = "a stamp behind its neighbours";

}  // namespace

StampGuard::Verdict StampGuard::check(const std::string& topic, std::int64_t stamp_ns, std::int64_t arrival_ns,
                                      std::optional<std::int64_t> host_ns) {
  const std::lock_guard lock(mutex_);
  Topic& own = topics_[topic];
  const std::int64_t offset_ns = stamp_ns - arrival_ns;
  Verdict verdict;
  if (!own.has_any) {
    const bool is_of_now = !host_ns || stamp_ns <= *host_ns + limits_.ahead_ns;
    if (!is_of_now) verdict = {.off_ns = stamp_ns - *host_ns, .reason = kAheadOfHost};
  } else if (stamp_ns < own.stamp_ns - limits_.back_ns) {
    verdict = {.off_ns = stamp_ns - own.stamp_ns, .reason = kBack};
  } else if (offset_ns > own.offset_ns + allowance_ns(own) && !agrees_with_another(own, stamp_ns, arrival_ns)) {
    verdict = {.off_ns = offset_ns - own.offset_ns, .reason = kAhead};
  }
  if (verdict.reason.empty()) {
    own.suspects = 0;
    if (own.has_any) {
      const std::int64_t interval_ns = std::max<std::int64_t>(stamp_ns - own.stamp_ns, 0);
      own.interval_ns += own.interval_ns == 0 ? interval_ns : (interval_ns - own.interval_ns) / kMeanOver;
      own.offset_ns += offset_ns > own.offset_ns ? offset_ns - own.offset_ns : (offset_ns - own.offset_ns) / kSlower;
    } else {
      own.offset_ns = offset_ns;
    }
  } else if (is_confirmed(own, stamp_ns, arrival_ns)) {
    verdict.outcome = Outcome::kClockStep;
    verdict.is_to_report = true;
    own.suspects = 0;
    own.offset_ns = offset_ns;
  } else {
    verdict.outcome = Outcome::kRejected;
    verdict.rejected = ++own.rejected;
    const auto reported = own.reported_ns.find(verdict.reason);
    verdict.is_to_report = reported == own.reported_ns.end() || arrival_ns - reported->second >= kReportPeriod_ns;
    if (verdict.is_to_report) own.reported_ns[verdict.reason] = arrival_ns;
    return verdict;
  }
  own.has_any = true;
  own.stamp_ns = stamp_ns;
  own.arrival_ns = arrival_ns;
  return verdict;
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

bool StampGuard::is_confirmed(Topic& topic, std::int64_t stamp_ns, std::int64_t arrival_ns) const {
  const std::int64_t interval_ns = stamp_ns - topic.suspect_stamp_ns;
  const std::int64_t ahead_ns = interval_ns - (arrival_ns - topic.suspect_arrival_ns);
  const bool agrees = topic.suspects > 0 && interval_ns > 0 && ahead_ns <= allowance_ns(topic);
  topic.suspects = agrees ? topic.suspects + 1 : 1;
  topic.suspect_stamp_ns = stamp_ns;
  topic.suspect_arrival_ns = arrival_ns;
  return topic.suspects >= limits_.confirmations;
}

}  // namespace panvo::runtime
