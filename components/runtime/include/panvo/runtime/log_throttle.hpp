// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace panvo::runtime {

/// Lets through one log line of a kind each ten seconds, and counts those between. Who writes the line names its kind. Safe to use from several
/// threads.
class LogThrottle {
 public:
  static constexpr std::int64_t kInterval_ns = 10'000'000'000;
  /// Kinds that are remembered; further ones share one turn while all of these are younger than the interval.
  static constexpr std::size_t kMostKeys = 50;

  /// Whether a line of this kind may be written at `now_ns`, and what to write after it: "" or " (3 more like this in the last 12 s)".
  /// nullopt: it is counted only. A time before the last line's (stamps of a recording may jump) is as one within the interval.
  std::optional<std::string> admit(std::string_view key, std::int64_t now_ns);

 private:
  struct Kind {
    std::optional<std::int64_t> written_ns{};
    std::uint64_t held_back = 0;
  };
  using Kinds = std::map<std::string, Kind, std::less<>>;

  Kind& kind_of(std::string_view key, std::int64_t now_ns);

  std::mutex mutex_;
  Kinds kinds_;
};

}  // namespace panvo::runtime
