// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

namespace panvo::runtime {

/// The messages that could not be used, by topic, sender and reason: diagnostics list them. Safe to use from several threads.
class Rejections {
 public:
  static constexpr std::int64_t kLogPeriod_ns = 10'000'000'000;
  /// Of one topic; what is more is counted as one, so that nobody fills memory by sending ever new nonsense.
  static constexpr std::size_t kMostCauses = 64;

  using Cause = std::pair<std::string, std::string>;  ///< sender ("" where it is not known) and reason
  struct Count {
    std::uint64_t messages = 0;
    std::string last_reason;
    std::map<Cause, std::uint64_t> causes;
  };

  /// Returns whether it is worth a line in the log: at most one in 10 s for each topic and reason.
  bool add(std::string_view topic, std::string_view reason, std::string_view sender = {});

  /// In order of the topics' names; those that had a message rejected.
  std::map<std::string, Count, std::less<>> snapshot() const;

 private:
  struct Topic {
    Count count;
    std::map<std::string, std::int64_t, std::less<>> told_ns;  // by reason, when it was last worth a line
  };
  mutable std::mutex mutex_;
  std::map<std::string, Topic, std::less<>> topics_;
};

}  // namespace panvo::runtime
