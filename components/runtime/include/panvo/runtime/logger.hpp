// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <spdlog/fmt/fmt.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

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

  Logger(std::string component, Write write) : component_(std::move(component)), write_(std::move(write)) {}

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

 private:
  std::string component_;
  Write write_;
};

}  // namespace panvo::runtime
