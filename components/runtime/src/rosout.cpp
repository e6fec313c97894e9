// SPDX-License-Identifier: Apache-2.0
#include "rosout.hpp"

#include <utility>

#include "rcl_interfaces/msg/Log.h"

namespace panvo::runtime {

/// A thread that publishes. Without the lock, as the output may log.
class Rosout::Publishing {
 public:
  explicit Publishing(Rosout& rosout) : rosout_(rosout) {
    const std::lock_guard lock(rosout_.mutex_);
    ++rosout_.publishing_;
    output_ = rosout_.output_.get();
  }
  ~Publishing() {
    const std::lock_guard lock(rosout_.mutex_);
    --rosout_.publishing_;
    rosout_.changed_.notify_all();
  }
  Publishing(const Publishing&) = delete;
  Publishing& operator=(const Publishing&) = delete;

  /// nullptr: closed.
  UntypedOutput* output() const { return output_; }

 private:
  Rosout& rosout_;
  UntypedOutput* output_ = nullptr;
};

void Rosout::open(std::shared_ptr<UntypedOutput> output) {
  const std::lock_guard lock(mutex_);
  output_ = std::move(output);
}

void Rosout::close() {
  std::shared_ptr<UntypedOutput> closed;  // destroyed without the lock
  std::unique_lock lock(mutex_);
  closed.swap(output_);
  changed_.wait(lock, [this] { return publishing_ == 0; });
}

void Rosout::publish(LogLevel level, const std::string& component, const std::string& text, std::int64_t time_ns) {
  const Publishing publishing(*this);
  if (!publishing.output()) return;
  constexpr std::int64_t kSecond = 1'000'000'000;
  auto message = std::make_shared<rcl_interfaces::msg::Log>();
  message->stamp().sec(static_cast<std::int32_t>(time_ns / kSecond));
  message->stamp().nanosec(static_cast<std::uint32_t>(time_ns % kSecond));
  message->level(static_cast<std::uint8_t>(level));
  message->name(component);
  message->msg(text);
  publishing.output()->publish(std::shared_ptr<const void>(std::move(message)));
}

}  // namespace panvo::runtime
