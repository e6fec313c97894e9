// SPDX-License-Identifier: Apache-2.0
#include "panvo/runner/queue_watch.hpp"

namespace panvo::runner {

bool QueueWatch::moves(const std::vector<runtime::QueueCounters>& queues) {
  bool moves = true;
  decltype(handled_) handled;
  for (const auto& queue : queues) {
    if (queue.waiting == 0) continue;
    const auto key = std::pair(queue.component, queue.input);
    const auto before = handled_.find(key);
    moves &= before == handled_.end() || before->second != queue.handled;
    handled[key] = queue.handled;
  }
  handled_ = std::move(handled);
  return moves;
}

}  // namespace panvo::runner
