// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/log_throttle.hpp"

#include <spdlog/fmt/fmt.h>

#include "clocks.hpp"
#include "panvo/runtime/logger.hpp"

namespace panvo::runtime {

Logger::Clock Logger::monotonic_clock() { return clocks::monotonic_ns; }

std::optional<std::string> LogThrottle::admit(std::string_view key, std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  auto& [written_ns, held_back] = kind_of(key, now_ns);
  if (written_ns && now_ns - *written_ns < kInterval_ns) {
    ++held_back;
    return std::nullopt;
  }
  std::string suffix;
  if (held_back > 0) {
    suffix = fmt::format(" ({} more like this in the last {} s)", held_back, (now_ns - *written_ns) / 1'000'000'000);
  }
  written_ns = now_ns;
  held_back = 0;
  return suffix;
}

LogThrottle::Kind& LogThrottle::kind_of(std::string_view key, std::int64_t now_ns) {
  if (const auto found = kinds_.find(key); found != kinds_.end()) return found->second;
  if (kinds_.size() >= kMaxKeys) {
    std::erase_if(kinds_, [now_ns](const auto& kind) { return now_ns - *kind.second.written_ns >= kInterval_ns; });
  }
  return kinds_[kinds_.size() < kMaxKeys ? std::string(key) : std::string()];
}

}  // namespace panvo::runtime
