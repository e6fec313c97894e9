// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "panvo/runtime/logger.hpp"
#include "panvo/runtime/output.hpp"

namespace panvo::runtime {

/// Publishes log lines on /rosout. Drops them while there is no output, at the start and end of a container.
/// Thread-safe.
class Rosout {
 public:
  void open(std::shared_ptr<UntypedOutput> output);
  /// Once this has returned, no thread publishes any more: the topic may go.
  void close();
  void publish(LogLevel level, const std::string& component, const std::string& text, std::int64_t time_ns);

 private:
  class Publishing;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::shared_ptr<UntypedOutput> output_;
  int publishing_ = 0;  // threads
};

}  // namespace panvo::runtime
