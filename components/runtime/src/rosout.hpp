// SPDX-License-Identifier: Apache-2.0
#pragma once

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
  void close() { open(nullptr); }
  void publish(LogLevel level, const std::string& component, const std::string& text, std::int64_t time_ns);

 private:
  std::mutex mutex_;
  std::shared_ptr<UntypedOutput> output_;
};

}  // namespace panvo::runtime
