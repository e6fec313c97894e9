// SPDX-License-Identifier: Apache-2.0
#include "html_sections.hpp"
#include "html_text.hpp"
#include "journey_text.hpp"

namespace panvo::evaluation {
namespace {

void add(std::string& list, const std::string& name, const std::string& value) {
  if (!value.empty()) list += "<dt>" + html(name) + "</dt><dd>" + html(value) + "</dd>\n";
}

void add_facts(std::string& list, const RunFacts& facts) {
  add(list, "system", facts.system + (facts.is_replay ? ", replayed (deterministic)" : ", not replayed"));
  add(list, "version", facts.version);
  add(list, "seed of the run", facts.seed);
  std::vector<std::string> changed;
  for (const auto& [name, value] : facts.changed_parameters) changed.push_back(name + " = " + value);
  add(list, "changed parameters", changed.empty() ? "none" : joined(changed));
  if (facts.wall_s) {
    add(list, "run time",
        fmt::format(
            "{:.0f} s{}{}", *facts.wall_s,
            facts.cpu_s ? fmt::format(", {:.0f} s of CPU time", *facts.cpu_s) : std::string(),
            facts.peak_memory_mb ? fmt::format(", peak memory {:.0f} MB", *facts.peak_memory_mb) : std::string()));
  }
  for (const auto& problem : facts.problems) add(list, "problem", problem);
}

}  // namespace

std::string facts_section(const JourneyReport& report) {
  const auto& run = report.run.frames.run;
  const auto& recording = report.run.frames.recording;
  std::string list;
  add(list, "run", run.name);
  if (run.facts) add_facts(list, *run.facts);
  add(list, "recording", std::filesystem::weakly_canonical(recording.folder).filename().string());
  add(list, "route, seed", recording.route + (recording.seed.empty() ? "" : ", " + recording.seed));
  add(list, "effects", joined(recording.effects));
  add(list, "landmarks", std::to_string(run.landmarks.size()) + " lines of landmarks.csv");
  add(list, "ground truth",
      fmt::format("{} poses, {:.0f} m", recording.truth.poses.size(), report.run.paths.travelled_m));
  add(list, "missing files", joined(run.missing));
  return html_section("Run settings", "", "<figure><dl>\n" + list + "</dl></figure>\n");
}

}  // namespace panvo::evaluation
