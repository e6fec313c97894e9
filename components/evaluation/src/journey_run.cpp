// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/journey_run.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "angle_units.hpp"
#include "csv_table.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/trajectory_files.hpp"
#include "text_file.hpp"

namespace panvo::evaluation {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

RunLandmark landmark_of(const CsvRow& row) { return {row.integer(0), row.integer(1), row.flag(2), row.pose(3)}; }

RunMatch match_of(const CsvRow& row) {
  auto heading = row.optional_number(3);
  if (heading) *heading *= kRadians;
  return {row.integer(0), row.text(1), row.integer(2), heading, row.text(4)};
}

RunCorrection correction_of(const CsvRow& row) {
  return {row.integer(0), row.integer(1), row.text(2), row.integer(3), row.pose(5), row.text(4)};
}

RunOutcome outcome_of(const CsvRow& row) {
  return {row.integer(0), row.integer(1), row.text(2), row.pose(4), row.pose(11), row.text(3)};
}

RunAzimuth azimuth_of(const CsvRow& row) {
  const bool is_valid = row.flag(3);
  return {row.integer(0), row.integer(1), is_valid ? row.optional_number(2) : std::nullopt};
}

RunQuality quality_of(const CsvRow& row) { return {row.integer(0), row.flag(1), row.integer(2), row.integer(3)}; }

RunState state_of(const CsvRow& row) {
  return {row.integer(0), row.text(1), row.text(2), row.optional_number(3), row.optional_number(4)};
}

RunIntegrity integrity_of(const CsvRow& row) {
  return {row.integer(0),         row.flag(1),           row.text(2), row.optional_number(3),
          row.optional_number(4), row.optional_number(5)};
}

template <class Entry>
void read_table(std::vector<Entry>& entries, JourneyRun& run, const std::string& name,
                const std::vector<std::string>& columns, Entry (*entry_of)(const CsvRow&)) {
  if (!fs::exists(run.folder / name)) return run.missing.push_back(name);
  for (const auto& row : read_csv(run.folder / name, columns)) entries.push_back(entry_of(row));
}

/// Files of sightings are not written in a run without any: then nothing is missing.
void forgive_sightings(JourneyRun& run) {
  const bool has_matches = fs::exists(run.folder / "matches.csv");
  const bool has_seen = std::any_of(run.matches.begin(), run.matches.end(),
                                    [](const RunMatch& match) { return match.state == "matched"; });
  if (!has_matches || has_seen) return;
  std::erase_if(run.missing, [](const auto& name) { return name == "corrections.csv" || name == "outcomes.csv"; });
}

std::string plain(const Json& json) { return json.is_string() ? json.get<std::string>() : json.dump(); }

std::optional<double> number_in(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_number() ? std::optional(json[key].get<double>()) : std::nullopt;
}

RunFacts read_facts(const fs::path& file) {
  Json json;
  try {
    json = Json::parse(read_text(file));
  } catch (const Json::parse_error& error) {
    throw InputError(file, std::string("is not valid JSON: ") + error.what(), "run again, or remove the file");
  }
  RunFacts facts;
  const auto text = [&](const char* key) { return json.contains(key) ? plain(json[key]) : std::string(); };
  facts.version = text("version");
  facts.system = fs::path(text("system_file")).filename().string();
  facts.seed = text("seed");
  facts.is_replay = text("replay") == "true";
  facts.wall_s = number_in(json, "wall_s");
  facts.cpu_s = number_in(json, "cpu_s");
  facts.peak_memory_mb = number_in(json, "peak_memory_mb");
  if (json.contains("problems")) {
    for (const auto& problem : json["problems"]) facts.problems.push_back(plain(problem));
  }
  if (json.contains("changed_parameters") && json["changed_parameters"].is_object()) {
    for (const auto& [component, parameters] : json["changed_parameters"].items()) {
      if (!parameters.is_object()) continue;
      for (const auto& [name, value] : parameters.items()) {
        facts.changed_parameters.emplace_back(std::string(component).append(".").append(name), plain(value));
      }
    }
  }
  return facts;
}

}  // namespace

JourneyRun read_journey_run(const fs::path& folder) {
  if (!fs::is_directory(folder)) {
    throw InputError(folder, "is not a folder", "name the folder given to `panvo run --out`");
  }
  JourneyRun run;
  run.folder = folder;
  run.name = fs::weakly_canonical(folder).filename().string();
  if (run.name.empty()) run.name = fs::weakly_canonical(folder).parent_path().filename().string();
  for (const char* name : {"odometry_enhanced.tum", "odometry_binocular.tum"}) {
    if (!fs::exists(folder / name)) {
      throw InputError(folder / name, "not found", "create the run with `panvo run enhanced_vo ... --out DIR`");
    }
  }
  run.enhanced = read_tum(folder / "odometry_enhanced.tum");
  run.binocular = read_tum(folder / "odometry_binocular.tum");
  if (const auto file = folder / "odometry_enhanced_covariance.csv"; fs::exists(file)) {
    run.enhanced_covariances = read_motion_covariances(file);
  } else {
    run.missing.push_back(file.filename().string());
  }
  read_table(run.landmarks, run, "landmarks.csv", with_pose({"stamp_ns", "id", "is_junction"}, ""), landmark_of);
  read_table(run.matches, run, "matches.csv", {"stamp_ns", "state", "landmark_id", "heading_deg", "reason"}, match_of);
  read_table(run.corrections, run, "corrections.csv",
             with_pose({"stamp_ns", "landmark_id", "state", "inliers", "reason"}, ""), correction_of);
  read_table(run.outcomes, run, "outcomes.csv",
             with_pose(with_pose({"stamp_ns", "landmark_id", "outcome", "reason"}, "before_"), "after_"), outcome_of);
  forgive_sightings(run);
  read_table(run.azimuths, run, "azimuth.csv", {"stamp_ns", "from_stamp_ns", "azimuth_change_rad", "valid"},
             azimuth_of);
  read_table(run.qualities, run, "quality.csv", {"stamp_ns", "reliable", "tracked", "inliers"}, quality_of);
  read_table(run.states, run, "states.csv", {"stamp_ns", "state", "reason", "position_sigma_m", "heading_sigma_rad"},
             state_of);
  read_table(run.integrity, run, "integrity.csv", {"stamp_ns", "usable", "reason", "risk", "hpl_m", "alert_limit_m"},
             integrity_of);
  if (const auto file = folder / "timing.json"; fs::exists(file)) {
    run.times = read_timing(file);
  } else {
    run.missing.push_back(file.filename().string());
  }
  if (const auto file = folder / "summary.json"; fs::exists(file)) {
    run.facts = read_facts(file);
  } else {
    run.missing.push_back(file.filename().string());
  }
  return run;
}

}  // namespace panvo::evaluation
