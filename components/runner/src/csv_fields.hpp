// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "panvo/runtime/parameters.hpp"

/// Fields of CSV result files.
namespace panvo::runner {

template <class Time>
std::string time_of(const Time& time) {
  return std::to_string(std::int64_t{time.sec()} * 1'000'000'000 + time.nanosec());
}

template <class Message>
std::string stamp_of(const Message& message) {
  return time_of(message.header().stamp());
}

/// Quoted, on one line.
inline std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c == '\n' ? ' ' : c;
  }
  return result + '"';
}

inline std::string number_or_nothing(double number) {
  return std::isfinite(number) ? runtime::to_text(number) : std::string();
}

}  // namespace panvo::runner
