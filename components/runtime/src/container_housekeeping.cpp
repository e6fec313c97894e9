// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <utility>

#include "clocks.hpp"
#include "container_implementation.hpp"

namespace panvo::runtime {

void Container::Implementation::keep_house() {
  std::int64_t last_ns = clocks::monotonic_ns();
  std::unique_lock lock(housekeeping_mutex_);
  while (!housekeeping_changed_.wait_for(lock, std::chrono::milliseconds(50), [this] { return housekeeping_ended_; })) {
    const auto to_finalize = std::exchange(to_finalize_, {});
    lock.unlock();
    bus_.join_discovered();
    bus_.tell_rejected();
    bus_.send_history();
    for (const std::uint64_t id : to_finalize) finalize(id);
    restart_failed();
    if (bus_.channels().size() != told_channels_) tell_nodes();  // a recorder has opened topics
    lock.lock();
    const std::int64_t now_ns = clocks::monotonic_ns();
    if (now_ns - last_ns < 1'000'000'000) continue;
    publish_diagnostics(static_cast<double>(now_ns - last_ns) * 1e-9);
    last_ns = now_ns;
  }
}

void Container::Implementation::publish_diagnostics(double interval_s) {
  diagnostic_msgs::msg::DiagnosticArray array;
  {
    const std::lock_guard lock(entries_mutex_);
    std::vector<const Context::State*> states;
    for (const auto& entry : entries_) {
      states.push_back(&entry->context->state());
      service_totals_.add(entry->services);
    }
    array = diagnostics_.collect(states, clocks::system_ns(), interval_s);
  }
  for (const auto& recipe : unmade_)  // changed on this thread only
    array.status().push_back(Diagnostics::of_unmade(recipe.description.name));
  array.status().push_back(process_use_.status(options_.name, clocks::process_cpu_ns(), interval_s));
  if (bus_.bridge()) {
    service_totals_.add(services_);
    array.status().push_back(service_totals_.status(options_.name, interval_s));
  }
  diagnostics_output_->publish(std::make_shared<const diagnostic_msgs::msg::DiagnosticArray>(std::move(array)));
}

void Container::Implementation::stop_housekeeping() {
  {
    const std::lock_guard lock(housekeeping_mutex_);
    housekeeping_ended_ = true;
  }
  housekeeping_changed_.notify_all();
  if (housekeeping_.joinable()) housekeeping_.join();
}

}  // namespace panvo::runtime
