// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>

#include "panvo/runtime/bridge.hpp"

namespace panvo::runtime {

/// Publishes /clock for ROS 2 nodes with use_sim_time. Only to other processes: our components and recorders use
/// stamps.
class PlayedClock {
 public:
  static TopicDescription topic();

  explicit PlayedClock(Bridge& bridge) : writer_(bridge.open_writer(topic())) {}

  /// Thread-safe. With several sources the latest time counts, so the clock goes back only at restart().
  void reach(std::int64_t stamp_ns);
  /// After it the clock may have gone back.
  void restart() { reached_ns_ = std::numeric_limits<std::int64_t>::min(); }

 private:
  const std::unique_ptr<BridgeWriter> writer_;
  std::atomic<std::int64_t> reached_ns_ = std::numeric_limits<std::int64_t>::min();
};

}  // namespace panvo::runtime
