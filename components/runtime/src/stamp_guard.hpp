// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace panvo::runtime {

/// Checks stamps against arrival times. Their difference is constant up to the transmission time. A stamp far ahead of
/// the expected one, or behind its predecessors, is suspected, and so are the following ones until a few consecutive
/// ones are consistent: then the sender's clock was set and the new time is accepted. Thread-safe; deterministic.
class StampGuard {
 public:
  struct Limits {
    std::int64_t ahead_ns = 500'000'000;        ///< ahead of the expected stamp
    std::int64_t back_ns = 500'000'000;         ///< behind the last stamp of the topic
    std::int64_t max_ahead_ns = 2'500'000'000;  ///< for topics below 1 Hz
    int confirmations = 5;                      ///< consecutive consistent messages that confirm a new time
  };
  enum class Outcome { kAccepted, kClockStep, kSuspected };
  struct Verdict {
    Outcome outcome = Outcome::kAccepted;
    std::int64_t off_ns = 0;  ///< offset of a stamp ahead (negative: behind), unless accepted
    std::string_view reason;  ///< of the suspicion
    int agreeing = 0;  ///< so many suspected messages just before are consistent with this one; others were wrong
  };

  explicit StampGuard(const Limits& limits) : limits_(limits) {}
  StampGuard() : StampGuard(Limits{}) {}

  /// `input`: a topic, as one reader gets it. `arrival_ns`: from a monotonic clock. `host_ns`: the host's clock, if stamps
  /// are current and not recorded; the first stamp of a topic must not be ahead of it.
  Verdict check(const std::string& input, std::int64_t stamp_ns, std::int64_t arrival_ns,
                std::optional<std::int64_t> host_ns);

 private:
  struct Topic {
    bool has_any = false;
    std::int64_t stamp_ns = 0, arrival_ns = 0;  // of the last accepted message
    std::int64_t offset_ns = 0;                 // stamp minus arrival of the fastest messages
    std::int64_t interval_ns = 0;               // mean interval between stamps; 0: unknown
    int suspects = 0;                           // consecutive suspected messages that are consistent
    std::int64_t suspect_stamp_ns = 0, suspect_arrival_ns = 0;
  };

  static void learn(Topic& topic, std::int64_t stamp_ns, std::int64_t offset_ns);
  std::int64_t allowance_ns(const Topic& topic) const;
  bool agrees_with_another(const Topic& own, std::int64_t stamp_ns, std::int64_t arrival_ns) const;
  int agreeing_suspects(const Topic& topic, std::int64_t stamp_ns, std::int64_t arrival_ns) const;

  const Limits limits_;
  std::mutex mutex_;
  std::map<std::string, Topic> topics_;  // by input
};

}  // namespace panvo::runtime
