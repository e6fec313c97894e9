// SPDX-License-Identifier: Apache-2.0
#include "run_json.hpp"

namespace panvo::runner {
namespace {

Json durations_json(const runtime::DurationHistogram& durations) {
  return {{"mean", durations.mean_ms()},
          {"median", durations.quantile_ms(0.5)},
          {"p95", durations.quantile_ms(0.95)},
          {"p99", durations.quantile_ms(0.99)},
          {"max", durations.max_ms()}};
}

}  // namespace

Json timing_json(const runtime::ComponentTimes& times_by_component) {
  Json components = Json::object();
  for (const auto& [component, stages] : times_by_component) {
    Json& stages_json = components[component]["stages"] = Json::object();
    for (const auto& [stage, times] : stages) {
      stages_json[stage] = {{"count", times.wall.count()},
                            {"wall_ms", durations_json(times.wall)},
                            {"cpu_ms", durations_json(times.cpu)}};
    }
  }
  return {{"components", std::move(components)}};
}

Json summary_json(const RunSummary& summary) {
  Json queues = Json::array();
  for (const auto& queue : summary.queues) {
    queues.push_back({{"component", queue.component},
                      {"input", queue.input},
                      {"received", queue.received},
                      {"handled", queue.handled},
                      {"dropped", queue.dropped}});
  }
  return {{"version", summary.version},
          {"system_file", summary.system_file},
          {"replay", summary.replay},
          {"seed", summary.seed},
          {"exit_status", summary.exit_status},
          {"interrupted", summary.interrupted},
          {"problems", summary.problems},
          {"frames_in", summary.frames_in},
          {"frames_out", summary.frames_out},
          {"frames_unreliable", summary.frames_unreliable},
          {"lines", summary.lines},
          {"wall_s", summary.wall_s},
          {"cpu_s", summary.cpu_s},
          {"peak_memory_mb", summary.peak_memory_mb},
          {"queues", std::move(queues)},
          {"changed_parameters", summary.changed_parameters}};
}

RunSummary summary_from(const Json& json) {
  RunSummary summary;
  json.at("version").get_to(summary.version);
  json.at("system_file").get_to(summary.system_file);
  json.at("replay").get_to(summary.replay);
  json.at("seed").get_to(summary.seed);
  json.at("exit_status").get_to(summary.exit_status);
  json.at("interrupted").get_to(summary.interrupted);
  json.at("problems").get_to(summary.problems);
  json.at("frames_in").get_to(summary.frames_in);
  json.at("frames_out").get_to(summary.frames_out);
  json.at("frames_unreliable").get_to(summary.frames_unreliable);
  json.at("lines").get_to(summary.lines);
  json.at("wall_s").get_to(summary.wall_s);
  json.at("cpu_s").get_to(summary.cpu_s);
  json.at("peak_memory_mb").get_to(summary.peak_memory_mb);
  for (const Json& queue : json.at("queues")) {
    summary.queues.push_back(
        {queue.at("component"), queue.at("input"), queue.at("received"), queue.at("handled"), queue.at("dropped")});
  }
  json.at("changed_parameters").get_to(summary.changed_parameters);
  return summary;
}

std::string to_text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace panvo::runner
