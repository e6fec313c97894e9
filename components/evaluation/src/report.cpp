// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/report.hpp"

#include <nlohmann/json.hpp>
#include <numbers>

#include "angle_units.hpp"
#include "format.hpp"

namespace panvo::evaluation {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Summary& summary) {
  return {{"count", summary.count},
          {"rmse", summary.rmse},
          {"mean", summary.mean},
          {"median", summary.median},
          {"max", summary.max}};
}

Json json_of(const SegmentErrors& errors) {
  Json lengths = Json::array();
  for (const SegmentError& error : errors.by_length) {
    lengths.push_back({{"length_m", error.length_m},
                       {"count", error.count},
                       {"translation_percent", error.translation_percent},
                       {"rotation_deg_per_m", error.rotation_deg_per_m}});
  }
  return {{"count", errors.count},
          {"translation_percent", errors.translation_percent},
          {"rotation_deg_per_m", errors.rotation_deg_per_m},
          {"by_length", std::move(lengths)}};
}

Json json_of(const Nees& nees) {
  return {{"samples", nees.samples},   {"expected", nees.dimension}, {"mean", nees.mean},
          {"lower_95", nees.lower_95}, {"upper_95", nees.upper_95},  {"inside_95", nees.inside_95}};
}

Json json_of(const Consistency& consistency) {
  return {{"steps", consistency.options.steps},
          {"truth_noise_m", consistency.options.truth_noise_m},
          {"truth_noise_deg", consistency.options.truth_noise_rad * kDegrees},
          {"unusable", consistency.unusable},
          {"motion", json_of(consistency.motion)},
          {"motion_translation", json_of(consistency.motion_translation)},
          {"motion_rotation", json_of(consistency.motion_rotation)},
          {"pose", consistency.pose ? json_of(*consistency.pose) : Json(nullptr)}};
}

Json json_of(const TimeSummary& time) {
  return {{"mean", time.mean_ms},
          {"median", time.median_ms},
          {"p95", time.p95_ms},
          {"p99", time.p99_ms},
          {"max", time.max_ms}};
}

Json json_of(const StageTimes& times) {
  Json stages = Json::array();
  for (const StageTime& time : times) {
    stages.push_back({{"component", time.component},
                      {"stage", time.stage},
                      {"count", time.count},
                      {"wall_ms", json_of(time.wall)},
                      {"cpu_ms", json_of(time.cpu)}});
  }
  return stages;
}

template <class Value>
Json or_null(const std::optional<Value>& value) {
  if (!value) return nullptr;
  if constexpr (std::is_arithmetic_v<Value>) {
    return *value;
  } else {
    return json_of(*value);
  }
}

Json relative_to_json(const std::optional<RelativePoseError>& error, const std::string& translation_unit,
                      const std::string& rotation_unit) {
  if (!error) return nullptr;
  return {{"translation_" + translation_unit, json_of(error->translation)},
          {"rotation_" + rotation_unit, json_of(error->rotation_deg)}};
}

Json json_of(const Evaluation& e) {
  return {
      {"name", e.name},
      {"source", e.source.string()},
      {"poses", e.poses},
      {"pairs", e.pairs},
      {"frames_unreliable", or_null(e.unreliable)},
      {"association", e.association == AssociationMethod::kInterpolate ? "interpolate" : "nearest"},
      {"association_tolerance_s", static_cast<double>(e.tolerance_ns) * 1e-9},
      {"association_largest_difference_s", static_cast<double>(e.max_difference_ns) * 1e-9},
      {"duration_s", e.duration_s},
      {"path_length_m", e.path_length_m},
      {"coverage_percent", e.coverage_percent},
      {"ate_start_m", or_null(e.ate_start_m)},
      {"ate_se3_m", or_null(e.ate_se3_m)},
      {"rotation_start_deg", or_null(e.rotation_start_deg)},
      {"scale_error_percent", or_null(e.scale_error_percent)},
      {"end_error_m", or_null(e.end_error_m)},
      {"end_error_percent", or_null(e.end_error_percent)},
      {"end_rotation_deg", or_null(e.end_rotation_deg)},
      {"segments", or_null(e.segments)},
      {"rpe_per_frame", relative_to_json(e.per_frame, "m", "deg")},
      {"rpe_per_metre", relative_to_json(e.per_metre, "m_per_m", "deg_per_m")},
      {"nees", or_null(e.nees)},
      {"timing", or_null(e.timing)},
  };
}

}  // namespace

std::string to_json(const Report& report) {
  Json evaluations = Json::array();
  for (const Evaluation& evaluation : report.evaluations) evaluations.push_back(json_of(evaluation));
  const Trajectory& truth = report.ground_truth;
  const Json document = {
      {"title", report.title},
      {"ground_truth",
       {{"source", truth.source.string()},
        {"format", truth.format},
        {"poses", truth.poses.size()},
        {"path_length_m", path_length_m(truth)}}},
      {"errors_aligned_by", to_string(report.evaluations.front().alignment)},
      {"estimates", std::move(evaluations)},
  };
  // Invalid UTF-8 in names is replaced instead of rejected.
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_csv(const Report& report) {
  std::string text =
      "estimate,stamp_ns,distance_m,true_x_m,true_y_m,true_z_m,estimate_x_m,estimate_y_m,estimate_z_m,"
      "error_x_m,error_y_m,error_z_m,error_m,rotation_x_deg,rotation_y_deg,rotation_z_deg,rotation_deg,yaw_deg\n";
  for (const Evaluation& evaluation : report.evaluations) {
    std::string name = evaluation.name;  // quoted according to RFC 4180
    for (std::size_t at = 0; (at = name.find('"', at)) != std::string::npos; at += 2) name.insert(at, 1, '"');
    for (const PoseError& error : evaluation.errors) {
      text += '"' + name + "\"," + std::to_string(error.stamp_ns);
      const auto add = [&](double value) { text += ',' + to_text(value, 9); };
      add(error.distance_m);
      for (const auto& vector : {error.ground_truth_m, error.estimate_m, error.translation_m}) {
        for (const double value : vector) add(value);
      }
      add(error.translation_m.norm());
      for (const double value : error.rotation_rad) add(value * kDegrees);
      add(error.rotation_rad.norm() * kDegrees);
      add(error.yaw_rad * kDegrees);
      text += '\n';
    }
  }
  return text;
}

}  // namespace panvo::evaluation
