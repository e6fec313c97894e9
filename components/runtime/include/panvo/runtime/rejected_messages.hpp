// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

namespace panvo::runtime {

/// Counts unusable messages by topic, sender and reason, for the diagnostics. Thread-safe.
class RejectedMessages {
 public:
  static constexpr std::int64_t kLogPeriod_ns = 10'000'000'000;
  /// Per topic; further causes share one entry, which bounds the memory.
  static constexpr std::size_t kMaxCauses = 64;

  using Cause = std::pair<std::string, std::string>;  ///< sender ("" if unknown) and reason
  struct Count {
    std::uint64_t messages = 0;
    std::string last_reason;
    std::map<Cause, std::uint64_t> causes;
  };

  /// Counts a message. Returns whether to log it: at most once in 10 s per topic and reason.
  bool add(std::string_view topic, std::string_view reason, std::string_view sender = {});

  /// Topics with rejected messages, in order of name.
  std::map<std::string, Count, std::less<>> snapshot() const;

 private:
  struct Topic {
    Count count;
    std::map<std::string, std::int64_t, std::less<>> told_ns;  // time of the last log line, by reason
  };
  mutable std::mutex mutex_;
  std::map<std::string, Topic, std::less<>> topics_;
};

}  // namespace panvo::runtime
