// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "journey_text.hpp"
#include "panvo/evaluation/journey_evaluation.hpp"

namespace panvo::evaluation {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
Json known(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json in_degrees(const std::optional<double>& value_rad) {
  return value_rad ? Json(*value_rad * kDegreesPerRadian) : Json(nullptr);
}

Json revisits_json(const RevisitScore& score) {
  Json rows = Json::array();
  for (const auto& revisit : score.revisits) {
    rows.push_back({{"number", revisit.number},
                    {"place", known(revisit.place)},
                    {"name", revisit.name},
                    {"route", revisit.route},
                    {"result", to_string(revisit.result)},
                    {"reason", revisit.reason},
                    {"landmark", known(revisit.landmark)},
                    {"stamp_ns", revisit.stamp_ns},
                    {"landmark_stamp_ns", known(revisit.landmark_stamp_ns)},
                    {"travelled_m", revisit.travelled_m},
                    {"entrance_deg", in_degrees(revisit.entrance_rad)},
                    {"distance_m", revisit.distance_m},
                    {"corrections", revisit.corrections},
                    {"binocular_m", known(revisit.binocular_m)},
                    {"before_m", known(revisit.before_m)},
                    {"after_m", known(revisit.after_m)},
                    {"before_heading_deg", in_degrees(revisit.before_heading_rad)},
                    {"after_heading_deg", in_degrees(revisit.after_heading_rad)},
                    {"landmark_error_m", known(revisit.landmark_m)},
                    {"beyond_landmark_m", known(revisit.beyond_m)},
                    {"wrong", revisit.is_wrong}});
  }
  return {{"listed", score.listed},       {"corrected", score.corrected},     {"heading_only", score.heading_only},
          {"given_up", score.given_up},   {"rejected", score.rejected},       {"missed", score.missed},
          {"elsewhere", score.elsewhere}, {"not_reached", score.not_reached}, {"applied", score.applied.size()},
          {"wrong", score.wrong},         {"rows", std::move(rows)}};
}

Json path_json(const PathScore& path) {
  return {{"ate_m", path.ate_m.rmse},
          {"ate_se3_m", path.ate_se3_m ? Json(path.ate_se3_m->rmse) : Json(nullptr)},
          {"flat_rms_m", path.flat_m.rmse},
          {"flat_median_m", path.flat_m.median},
          {"flat_percent_of_way", path.percent_of_way},
          {"heading_rms_deg", path.heading_rad.rmse * kDegreesPerRadian},
          {"final_m", path.final_m},
          {"worst_m", path.worst_m},
          {"worst_at_m", path.worst_at_m}};
}

Json nees_json(const Nees& nees) {
  return {{"dimension", nees.dimension}, {"mean", nees.mean}, {"inside_95", nees.inside_95}, {"samples", nees.samples}};
}

Json paths_json(const PathScores& paths) {
  Json json{{"travelled_m", paths.travelled_m},
            {"duration_s", paths.duration_s},
            {"binocular", path_json(paths.binocular)},
            {"enhanced", path_json(paths.enhanced)},
            {"ratio", paths.ratio},
            {"unlocated_m", paths.unlocated_m},
            {"nees", nullptr}};
  if (paths.consistency) {
    json["nees"] = {{"plane", nees_json(paths.consistency->plane)}, {"full", nees_json(paths.consistency->full)}};
  }
  return json;
}

Json azimuth_json(const AzimuthScore& score) {
  Json kinds = Json::array();
  for (const auto& kind : score.kinds) {
    kinds.push_back({{"kind", kind.kind},
                     {"episodes", kind.episodes},
                     {"duration_s", kind.duration_s},
                     {"binocular_rms_deg", in_degrees(kind.binocular_rms_rad)},
                     {"compass_rms_deg", in_degrees(kind.compass_rms_rad)},
                     {"enhanced_rms_deg", in_degrees(kind.enhanced_rms_rad)},
                     {"binocular_worst_deg", in_degrees(kind.binocular_worst_rad)},
                     {"compass_worst_deg", in_degrees(kind.compass_worst_rad)},
                     {"enhanced_worst_deg", in_degrees(kind.enhanced_worst_rad)}});
  }
  Json episodes = Json::array();
  for (const auto& episode : score.episodes) {
    episodes.push_back({{"kind", episode.kind},
                        {"from_ns", episode.from_ns},
                        {"to_ns", episode.to_ns},
                        {"turned_deg", in_degrees(episode.turned_rad)},
                        {"binocular_deg", in_degrees(episode.binocular_rad)},
                        {"compass_deg", in_degrees(episode.compass_rad)},
                        {"compass_share", episode.compass_share},
                        {"enhanced_deg", in_degrees(episode.enhanced_rad)}});
  }
  return {{"kinds", std::move(kinds)}, {"episodes", std::move(episodes)}};
}

Json stages_json(const std::vector<StageRow>& stages) {
  Json rows = Json::array();
  for (const auto& row : stages) {
    Json json{{"item", row.item}, {"paper_ms", known(row.paper_ms)}, {"component", nullptr}, {"stage", nullptr}};
    if (row.ours) {
      json["component"] = row.ours->component;
      json["stage"] = row.ours->stage;
      json["median_ms"] = row.ours->wall.median_ms;
      json["p95_ms"] = row.ours->wall.p95_ms;
      json["p99_ms"] = row.ours->wall.p99_ms;
    }
    rows.push_back(std::move(json));
  }
  return rows;
}

Json run_json(const RunEvaluation& run) {
  return {{"folder", run.frames.run.folder.string()}, {"paths", paths_json(run.paths)},
          {"revisits", revisits_json(run.revisits)},  {"azimuth", azimuth_json(run.azimuth)},
          {"stages", stages_json(run.stages)},        {"missing", run.frames.run.missing}};
}

}  // namespace

std::string journey_json(const JourneyReport& report) {
  Json json{{"title", report.title},
            {"recording", report.run.frames.recording.folder.string()},
            {"run", run_json(report.run)},
            {"paper_run", nullptr}};
  if (report.paper_run) json["paper_run"] = run_json(*report.paper_run);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace panvo::evaluation
