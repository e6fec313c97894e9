// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "panvo/runtime/container.hpp"

namespace panvo::runner {

/// Notices components that no longer handle messages, by comparing the counters of their queues from call to call.
class QueueWatch {
 public:
  /// False if messages wait in a queue of which none has been handled since the previous call, at which some already
  /// waited. Call it at intervals far above the time that a component needs for one message.
  bool moves(const std::vector<runtime::QueueCounters>& queues);

 private:
  std::map<std::pair<std::string, std::string>, std::uint64_t> handled_;  // of the queues in which messages wait
};

}  // namespace panvo::runner
