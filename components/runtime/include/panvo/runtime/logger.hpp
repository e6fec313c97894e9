// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <spdlog/fmt/fmt.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "panvo/runtime/log_throttle.hpp"

namespace panvo::runtime {

enum class LogLevel : std::uint8_t {
  kDebug = 10,
  kInfo = 20,
  kWarning = 30,
  kError = 40
};  // rcl_interfaces/msg/Log's values

/// What a component says to people: to stderr, the run's log file and rosout. Safe to use from several threads.
class Logger {
 public:
  using Write = std::function<void(LogLevel, const std::string& component, const std::string& text)>;
  using Clock = std::function<std::int64_t()>;  // ns

  /// `clock` is what throttled lines are counted by: the stamp of what is processed in replay, so that a replay's log is the same each time.
  Logger(std::string component, Write write, Clock clock = monotonic_clock())
      : component_(std::move(component)), write_(std::move(write)), clock_(std::move(clock)) {}

  template <class... Args>
  void debug(fmt::format_string<Args...> format, Args&&... args) const {
    write_(LogLevel::kDebug, component_, fmt::format(format, std::forward<Args>(args)...));
  }
  template <class... Args>
  void info(fmt::format_string<Args...> format, Args&&... args) const {
    write_(LogLevel::kInfo, component_, fmt::format(format, std::forward<Args>(args)...));
  }
  template <class... Args>
  void warn(fmt::format_string<Args...> format, Args&&... args) const {
    write_(LogLevel::kWarning, component_, fmt::format(format, std::forward<Args>(args)...));
  }
  template <class... Args>
  void error(fmt::format_string<Args...> format, Args&&... args) const {
    write_(LogLevel::kError, component_, fmt::format(format, std::forward<Args>(args)...));
  }

  /// For what may come with every message: once each ten seconds and `key`, with the number of those between. The key is the kind of line, and
  /// names what it is about where there are several ("landmark 3"), but not what changes from one to the next.
  template <class... Args>
  void warn_throttled(std::string_view key, fmt::format_string<Args...> format, Args&&... args) const {
    if (const auto suffix = throttle_.admit(key, clock_())) {
      write_(LogLevel::kWarning, component_, fmt::format(format, std::forward<Args>(args)...) + *suffix);
    }
  }
  template <class... Args>
  void info_throttled(std::string_view key, fmt::format_string<Args...> format, Args&&... args) const {
    if (const auto suffix = throttle_.admit(key, clock_())) {
      write_(LogLevel::kInfo, component_, fmt::format(format, std::forward<Args>(args)...) + *suffix);
    }
  }

 private:
  static Clock monotonic_clock();

  std::string component_;
  Write write_;
  Clock clock_;
  mutable LogThrottle throttle_;
};

}  // namespace panvo::runtime
