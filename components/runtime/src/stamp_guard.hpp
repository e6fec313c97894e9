// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace panvo::runtime {

/// Whether stamps agree with their neighbours. A stamp runs with the time at which messages arrive: what one is ahead of the other stays the same
/// but for the time that a message takes. A stamp far ahead of that, or before those that came, is rejected, and so are those that follow
/// it, until a few in a row agree with each other: then the sender's clock was set, and the new time is accepted. Safe to use from several
/// threads; the same calls give the same verdicts.
class StampGuard {
 public:
  struct Limits {
    std::int64_t ahead_ns = 500'000'000;         ///< of where a stamp is expected
    std::int64_t back_ns = 500'000'000;          ///< before the last stamp of its topic
    std::int64_t most_ahead_ns = 2'500'000'000;  ///< for topics of less than one message a second
    int confirmations = 5;                       ///< messages that must agree with each other on a new time
  };
  enum class Outcome { kAccepted, kClockStep, kRejected };
  struct Verdict {
    Outcome outcome = Outcome::kAccepted;
    std::int64_t off_ns = 0;     ///< by how much the stamp is ahead (negative: back), unless accepted
    std::string_view reason;     ///< of a rejection
    bool is_to_report = false;   ///< a step, or the first of its reason in 10 s
    std::uint64_t rejected = 0;  ///< of this topic so far
  };

  explicit StampGuard(const Limits& limits) : limits_(limits) {}
  StampGuard() : StampGuard(Limits{}) {}

  /// `arrival_ns`: by a clock that is never set. `host_ns`: the host's own clock, where stamps are of now and not of a recording: the
  /// first stamp of a topic may not be ahead of it.
  Verdict check(const std::string& topic, std::int64_t stamp_ns, std::int64_t arrival_ns,
                std::optional<std::int64_t> host_ns);

 private:
  struct Topic {
    bool has_any = false;
    std::int64_t stamp_ns = 0, arrival_ns = 0;  // the last that was accepted
    std::int64_t offset_ns = 0;                 // stamp minus arrival of those that came fastest
    std::int64_t interval_ns = 0;               // between stamps, in the mean; 0: not known
    int suspects = 0;                           // rejected in a row that agree with each other
    std::int64_t suspect_stamp_ns = 0, suspect_arrival_ns = 0;
    std::uint64_t rejected = 0;
    std::map<std::string_view, std::int64_t> reported_ns;
  };

  std::int64_t allowance_ns(const Topic& topic) const;
  bool agrees_with_another(const Topic& own, std::int64_t stamp_ns, std::int64_t arrival_ns) const;
  bool is_confirmed(Topic& topic, std::int64_t stamp_ns, std::int64_t arrival_ns) const;

  const Limits limits_;
  std::mutex mutex_;
  std::map<std::string, Topic> topics_;
};

}  // namespace panvo::runtime
