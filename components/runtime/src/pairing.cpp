// SPDX-License-Identifier: Apache-2.0
#include "pairing.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>

namespace panvo::runtime {

void Pairing::take(int side, std::int64_t stamp_ns, const SamplePtr& sample) {
  SamplePtr partner;
  std::int64_t partner_ns = 0;
  {
    const std::lock_guard lock(mutex_);
    Waiting& own = waiting_[side];
    Waiting& other = waiting_[1 - side];
    if (const auto found = find_partner(other, stamp_ns); found != other.end()) {
      partner_ns = found->first;
      partner = found->second.sample;
      // Older waiting messages have no partner: topics arrive in order.
      drop_before(own, stamp_ns);
      drop_before(other, partner_ns);
      other.erase(found);
    } else {
      own[stamp_ns] = {sample, held_++};
      if (own.size() > port_.depth) drop_first(own);
    }
  }
  if (!partner) return;
  worker_.push(port_, side == 0 ? Task{.first = sample, .second = partner, .stamp_ns = stamp_ns}
                                : Task{.first = partner, .second = sample, .stamp_ns = partner_ns});
}

Pairing::Waiting::iterator Pairing::find_partner(Waiting& waiting, std::int64_t stamp_ns) const {
  const auto after = waiting.lower_bound(stamp_ns);
  auto nearest = after;
  if (after != waiting.begin()) {
    const auto before = std::prev(after);
    if (after == waiting.end() || stamp_ns - before->first <= after->first - stamp_ns) nearest = before;
  }
  if (nearest == waiting.end() || std::abs(nearest->first - stamp_ns) > tolerance_ns_) return waiting.end();
  return nearest;
}

void Pairing::drop_before(Waiting& waiting, std::int64_t stamp_ns) {
  while (!waiting.empty() && waiting.begin()->first < stamp_ns) {
    waiting.erase(waiting.begin());
    worker_.count_dropped(port_);
  }
}

void Pairing::drop_first(Waiting& waiting) {
  waiting.erase(std::ranges::min_element(waiting, {}, [](const auto& held) { return held.second.number; }));
  worker_.count_dropped(port_);
}

}  // namespace panvo::runtime
