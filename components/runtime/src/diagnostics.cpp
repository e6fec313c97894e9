// SPDX-License-Identifier: Apache-2.0
#include "diagnostics.hpp"

#include <spdlog/fmt/fmt.h>

#include <set>
#include <string>
#include <utility>

namespace panvo::runtime {
namespace {

constexpr std::uint8_t kOk = 0, kWarning = 1, kError = 2;  // diagnostic_msgs/msg/DiagnosticStatus's values

void add(diagnostic_msgs::msg::DiagnosticStatus& status, const std::string& key, const std::string& value) {
  diagnostic_msgs::msg::KeyValue entry;
  entry.key(key);
  entry.value(value);
  status.values().push_back(entry);
}

/// Those of Context::on_diagnostics. Its exceptions are told, as they would end the process on this thread.
DiagnosticValues own_values(const Context::State& component) {
  try {
    return component.diagnose();
  } catch (const std::exception& error) {
    return {{"own values", fmt::format("not available: {}", error.what())}};
  }
}

}  // namespace

diagnostic_msgs::msg::DiagnosticArray Diagnostics::collect(const std::vector<const Context::State*>& components,
                                                           std::int64_t stamp_ns, double interval_s) {
  diagnostic_msgs::msg::DiagnosticArray array;
  array.header().stamp().sec(static_cast<std::int32_t>(stamp_ns / 1'000'000'000));
  array.header().stamp().nanosec(static_cast<std::uint32_t>(stamp_ns % 1'000'000'000));
  for (const Context::State* component : components) {
    diagnostic_msgs::msg::DiagnosticStatus status;
    status.name("panvo: " + component->description.name);
    status.hardware_id("none");
    const std::uint64_t dropped = tell_inputs(*component, interval_s, status) + tell_overwritten(*component, status);
    Rejected rejected = tell_refused(*component, status);
    if (const Rejected more = tell_rejections(*component, status); more.messages > 0) {
      rejected = {rejected.messages + more.messages, more.why};
    }
    tell_cpu(*component, interval_s, status);
    for (const auto& [stage, times] : component->times.snapshot()) {
      add(status, stage + " time",
          fmt::format("mean {:.2f} ms, p95 {:.2f} ms, max {:.2f} ms, CPU mean {:.2f} ms", times.wall.mean_ms(),
                      times.wall.quantile_ms(0.95), times.wall.max_ms(), times.cpu.mean_ms()));
    }
    for (const auto& [key, value] : own_values(*component)) add(status, key, value);
    if (component->restarts > 0) add(status, "restarted", fmt::format("{} times, after an error", component->restarts));
    const auto set_aside = component->files_set_aside();
    for (const auto& text : set_aside) add(status, "file", text);
    if (component->failed()) {
      status.level(kError);
      status.message("stopped by an error, see the log");
    } else if (dropped > 0) {
      status.level(kWarning);
      status.message(fmt::format("too slow: {} messages dropped in the last {:.0f} s", dropped, interval_s));
    } else if (rejected.messages > 0) {
      status.level(kWarning);
      status.message(fmt::format("{} messages could not be used in the last {:.0f} s: {}", rejected.messages,
                                 interval_s, rejected.why));
    } else if (!set_aside.empty()) {
      status.level(kWarning);
      status.message(set_aside.front() + ": previous runs that read it failed");
    } else {
      status.level(kOk);
      status.message(component->finalized ? "shut down" : component->active ? "runs" : "inactive: gets no messages");
    }
    array.status().push_back(std::move(status));
  }
  return array;
}

diagnostic_msgs::msg::DiagnosticStatus Diagnostics::of_unmade(const std::string& name) {
  diagnostic_msgs::msg::DiagnosticStatus status;
  status.name("panvo: " + name);
  status.hardware_id("none");
  status.level(kError);
  status.message("stopped by an error and could not be restarted, see the log");
  return status;
}

std::uint64_t Diagnostics::tell_inputs(const Context::State& component, double interval_s,
                                       diagnostic_msgs::msg::DiagnosticStatus& status) {
  std::uint64_t newly_dropped = 0;
  for (const auto& worker : component.workers) {
    for (const auto& port : worker->counters()) {
      Previous& previous = previous_[component.description.name + "\n" + port.input];
      if (port.received < previous.received) previous = {};  // replaced by another component of that name
      newly_dropped += port.dropped - previous.dropped;
      add(status, port.input + " rate",
          fmt::format("{:.1f} Hz", static_cast<double>(port.handled - previous.handled) / interval_s));
      add(status, port.input + " latency",
          fmt::format("median {:.2f} ms, p95 {:.2f} ms, max {:.2f} ms", port.latency.quantile_ms(0.5),
                      port.latency.quantile_ms(0.95), port.latency.max_ms()));
      add(status, port.input + " messages",
          fmt::format("{} received, {} handled, {} dropped, {} waiting, {} undecodable", port.received, port.handled,
                      port.dropped, port.waiting, port.undecodable));
      previous.received = port.received;
      previous.handled = port.handled;
      previous.dropped = port.dropped;
    }
  }
  return newly_dropped;
}

void Diagnostics::tell_cpu(const Context::State& component, double interval_s,
                           diagnostic_msgs::msg::DiagnosticStatus& status) {
  const auto times = component.times.snapshot();
  double cpu_ms = 0;
  std::set<std::string> inputs;  // that messages of two workers have in common
  for (const auto& worker : component.workers) {
    for (const auto& port : worker->counters()) inputs.insert(port.input);
  }
  for (const auto& input : inputs) {
    const auto found = times.find(input);  // the time of a whole message, which contains that of its stages
    if (found != times.end()) cpu_ms += found->second.cpu.mean_ms() * static_cast<double>(found->second.cpu.count());
  }
  Previous& previous = previous_[component.description.name + "\nCPU"];
  if (cpu_ms < previous.cpu_ms) previous = {};  // replaced by another component of that name
  add(status, "CPU", fmt::format("{:.1f} %", (cpu_ms - std::exchange(previous.cpu_ms, cpu_ms)) / interval_s / 10));
}

std::uint64_t Diagnostics::tell_overwritten(const Context::State& component,
                                            diagnostic_msgs::msg::DiagnosticStatus& status) {
  std::uint64_t newly_overwritten = 0;
  for (const Channel* channel : component.inputs) {
    const std::uint64_t overwritten = channel->counters().overwritten;
    if (overwritten == 0) continue;
    const std::string& topic = channel->topic().name;
    add(status, topic + " overwritten", fmt::format("{} messages, in shared memory while being read", overwritten));
    Previous& previous = previous_[component.description.name + "\n" + topic];
    newly_overwritten += overwritten - std::exchange(previous.overwritten, overwritten);
  }
  return newly_overwritten;
}

Diagnostics::Rejected Diagnostics::tell_rejections(const Context::State& component,
                                                   diagnostic_msgs::msg::DiagnosticStatus& status) {
  Rejected newly;
  const std::string& name = component.description.name;
  for (const auto& [topic, count] : component.rejections.snapshot()) tell_rejections(name, topic, count, status, newly);
  for (const Channel* channel : component.host.bus.channels()) {
    if (!channel->is_read_by(&component) && !channel->is_published_by(name)) continue;
    const auto count = channel->rejected();
    // Separate from the component's own rejections on the same topic.
    if (count.messages > 0) tell_rejections(name + "\ninvalid", channel->topic().name, count, status, newly);
  }
  return newly;
}

void Diagnostics::tell_rejections(const std::string& component, const std::string& topic,
                                  const RejectedMessages::Count& count, diagnostic_msgs::msg::DiagnosticStatus& status,
                                  Rejected& newly) {
  add(status, topic + " rejected", fmt::format("{} messages; the last {}", count.messages, count.last_reason));
  for (const auto& [cause, messages] : count.causes) {
    const auto& [sender, reason] = cause;
    if (!sender.empty())
      add(status, topic + " rejected from " + sender, fmt::format("{} messages: {}", messages, reason));
  }
  Previous& previous = previous_[component + "\n" + topic];
  if (count.messages < previous.rejected) previous.rejected = 0;  // as above
  if (const auto more = count.messages - std::exchange(previous.rejected, count.messages); more > 0) {
    newly.messages += more;
    newly.why = topic + " " + count.last_reason;
  }
}

Diagnostics::Rejected Diagnostics::tell_refused(const Context::State& component,
                                                diagnostic_msgs::msg::DiagnosticStatus& status) {
  Rejected newly;
  for (const Channel* channel : component.inputs) {
    const auto counters = channel->counters();
    const std::uint64_t refused = counters.too_large + counters.too_fast;
    if (refused == 0) continue;
    const std::string& topic = channel->topic().name;
    add(status, topic + " refused",
        fmt::format("{} larger than max_message_mb, {} beyond max_topic_rate_hz", counters.too_large,
                    counters.too_fast));
    Previous& previous = previous_[component.description.name + "\n" + topic];
    if (const auto more = refused - std::exchange(previous.refused, refused); more > 0) {
      newly.messages += more;
      newly.why = topic + (counters.too_large > 0 ? " has messages that are too large" : " has too many messages");
    }
  }
  return newly;
}

}  // namespace panvo::runtime
