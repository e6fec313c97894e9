// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>

#include "panvo/runtime/bridge.hpp"

namespace panvo::runtime {

/// /clock of what is played, for ROS 2's nodes with use_sim_time. Components here go by stamps and have no use for it, nor recorders, so that it only
/// leaves the process.
class PlayedClock {
 public:
  static TopicDescription topic();

  explicit PlayedClock(Bridge& bridge) : writer_(bridge.open_writer(topic())) {}

  /// From any thread. Of several sources, the latest time counts: a clock that went back would unsettle who reads it.
  void reach(std::int64_t stamp_ns);

 private:
  const std::unique_ptr<BridgeWriter> writer_;
  std::atomic<std::int64_t> reached_ns_ = std::numeric_limits<std::int64_t>::min();
};

}  // namespace panvo::runtime
