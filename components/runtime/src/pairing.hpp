// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <mutex>

#include "worker.hpp"

namespace panvo::runtime {

/// Pairs messages of two topics whose stamps differ by at most `tolerance_ns`. A message is paired as soon as a partner
/// within the tolerance exists, with the nearest of those that wait. Messages that are older than a paired one of their
/// topic are dropped and counted; so are the first to arrive of those that exceed the port's depth, whose stamps are the
/// latest if the clock was set back. Thread-safe.
class Pairing {
 public:
  Pairing(Worker& worker, Port& port, std::int64_t tolerance_ns)
      : worker_(worker), port_(port), tolerance_ns_(tolerance_ns) {}

  /// `side`: 0 for the first topic, 1 for the second.
  void take(int side, std::int64_t stamp_ns, const SamplePtr& sample);

 private:
  struct Held {
    SamplePtr sample;
    std::uint64_t number;  // in order of arrival
  };
  using Waiting = std::map<std::int64_t, Held>;  // by stamp

  Waiting::iterator find_partner(Waiting& waiting, std::int64_t stamp_ns) const;
  void drop_before(Waiting& waiting, std::int64_t stamp_ns);
  void drop_first(Waiting& waiting);

  Worker& worker_;
  Port& port_;
  const std::int64_t tolerance_ns_;
  std::mutex mutex_;
  Waiting waiting_[2];
  std::uint64_t held_ = 0;  // so far
};

}  // namespace panvo::runtime
