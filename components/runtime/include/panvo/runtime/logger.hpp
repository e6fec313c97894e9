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

/// Log of a component: to stderr, the run's log file and /rosout. Thread-safe.
class Logger {
 public:
  using Write = std::function<void(LogLevel, const std::string& component, const std::string& text)>;
  using Clock = std::function<std::int64_t()>;  // ns

  /// `clock` times the throttled lines. In replay it is the stamp of the processed message, so the log is reproducible.
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

  /// For warnings that may occur with every message: one line per `key` every 10 s, with the number of suppressed
  /// lines. The key names the kind of line and, if needed, its subject ("landmark 3"), without values that change from
  /// line to line.
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
