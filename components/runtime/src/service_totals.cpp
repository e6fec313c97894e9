// SPDX-License-Identifier: Apache-2.0
#include "service_totals.hpp"

#include <fmt/format.h>

#include <utility>

namespace panvo::runtime {

void ServiceTotals::add(const std::vector<std::unique_ptr<BridgeService>>& services) {
  for (const auto& service : services) {
    const auto counters = service->counters();
    now_.received += counters.received;
    now_.answered += counters.answered;
    now_.malformed += counters.malformed;
    now_.dropped += counters.dropped;
    now_.refused += counters.refused;
    now_.unanswered += counters.unanswered;
  }
}

diagnostic_msgs::msg::DiagnosticStatus ServiceTotals::status(const std::string& container, double interval_s) {
  const ServiceCounters now = std::exchange(now_, {});
  const ServiceCounters before = std::exchange(told_, now);
  // Counts decrease when a component is unloaded.
  const auto since = [](std::uint64_t count, std::uint64_t then) { return count > then ? count - then : 0; };
  const auto refused = since(now.refused, before.refused), dropped = since(now.dropped, before.dropped);
  diagnostic_msgs::msg::DiagnosticStatus status;
  status.name("panvo: requests to " + container);
  status.hardware_id("none");
  diagnostic_msgs::msg::KeyValue entry;
  entry.key("requests");
  entry.value(fmt::format("{} received, {} answered, {} refused, {} dropped, {} malformed, {} unanswered", now.received,
                          now.answered, now.refused, now.dropped, now.malformed, now.unanswered));
  status.values().push_back(entry);
  status.level(refused + dropped > 0 ? 1 : 0);
  status.message(refused + dropped > 0 ? fmt::format("{} requests refused and {} dropped in the last {:.0f} s", refused,
                                                     dropped, interval_s)
                                       : "answers");
  return status;
}

}  // namespace panvo::runtime
