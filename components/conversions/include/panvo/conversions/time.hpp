// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "builtin_interfaces/msg/Time.h"

/// Conversion of message times to nanoseconds since the epoch of their clock.
namespace panvo::conversions {

inline std::int64_t to_ns(const builtin_interfaces::msg::Time& stamp) {
  return std::int64_t{stamp.sec()} * 1'000'000'000 + std::int64_t{stamp.nanosec()};
}

/// The stamp of any message with a header.
template <class Message>
std::int64_t stamp_ns(const Message& message) {
  return to_ns(message.header().stamp());
}

/// `ns` must fit into the signed 32-bit seconds of ROS, i.e. until 2038.
inline builtin_interfaces::msg::Time to_stamp(std::int64_t ns) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  std::int64_t seconds = ns / kSecond;
  std::int64_t rest = ns % kSecond;
  if (rest < 0) {  // before the epoch: nanosec counts forward from the second before
    --seconds;
    rest += kSecond;
  }
  builtin_interfaces::msg::Time stamp;
  stamp.sec(static_cast<std::int32_t>(seconds));
  stamp.nanosec(static_cast<std::uint32_t>(rest));
  return stamp;
}

}  // namespace panvo::conversions
