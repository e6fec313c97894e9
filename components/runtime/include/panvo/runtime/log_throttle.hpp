// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace panvo::runtime {

/// Passes one log line per key every 10 s and counts those suppressed. Thread-safe.
class LogThrottle {
 public:
  static constexpr std::int64_t kInterval_ns = 10'000'000'000;
  /// Maximum number of keys; further keys share one entry while all of these are younger than the interval.
  static constexpr std::size_t kMaxKeys = 50;

  /// Returns the suffix for the log line, "" or " (3 more like this in the last 12 s)", or nullopt if the line is
  /// suppressed. A `now_ns` before the last line (recorded stamps may jump) counts as within the interval.
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
