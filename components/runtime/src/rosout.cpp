// SPDX-License-Identifier: Apache-2.0
#include "rosout.hpp"

#include <utility>

#include "rcl_interfaces/msg/Log.h"

namespace panvo::runtime {

void Rosout::open(std::shared_ptr<UntypedOutput> output) {
  const std::lock_guard lock(mutex_);
  output_ = std::move(output);
}

void Rosout::publish(LogLevel level, const std::string& component, const std::string& text, std::int64_t time_ns) {
  std::shared_ptr<UntypedOutput> output;
  {
    const std::lock_guard lock(mutex_);
    output = output_;
  }
  if (!output) return;
  constexpr std::int64_t kSecond = 1'000'000'000;
  auto message = std::make_shared<rcl_interfaces::msg::Log>();
  message->stamp().sec(static_cast<std::int32_t>(time_ns / kSecond));
  message->stamp().nanosec(static_cast<std::uint32_t>(time_ns % kSecond));
  message->level(static_cast<std::uint8_t>(level));
  message->name(component);
  message->msg(text);
  output->publish(std::shared_ptr<const void>(std::move(message)));
}

}  // namespace panvo::runtime
