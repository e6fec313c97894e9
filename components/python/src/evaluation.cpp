// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "panvo/evaluation/evaluation.hpp"
#include "panvo/evaluation/report.hpp"
#include "panvo/evaluation/run_folder.hpp"
#include "panvo/evaluation/trajectory_files.hpp"
#include "trajectory_arrays.hpp"

namespace panvo::python {
namespace {

using evaluation::Alignment;
using evaluation::AssociationMethod;

bool is_path(const py::object& object) { return py::isinstance<py::str>(object) || py::hasattr(object, "__fspath__"); }

evaluation::Estimate estimate_of(const py::object& argument) {
  if (is_path(argument)) return evaluation::read_estimate(argument.cast<std::filesystem::path>());
  evaluation::Estimate estimate;
  estimate.name = "estimate";
  estimate.trajectory = trajectory_of(argument, "estimate");
  return estimate;
}

evaluation::Trajectory truth_of(const py::object& argument) {
  if (is_path(argument)) return evaluation::read_trajectory(argument.cast<std::filesystem::path>());
  return trajectory_of(argument, "ground_truth");
}

template <class Value>
Value choice(const std::string& name, const std::string& given, const std::map<std::string, Value>& choices) {
  if (const auto found = choices.find(given); found != choices.end()) return found->second;
  std::vector<std::string> names;
  names.reserve(choices.size());
  for (const auto& [known, value] : choices) names.push_back(known);
  throw py::value_error(fmt::format("{}: expected one of {}, not '{}'", name, fmt::join(names, ", "), given));
}

py::dict evaluate(const py::object& estimate, const py::object& ground_truth, const std::string& align,
                  const std::string& associate, double tolerance_s, const std::vector<double>& segments_m) {
  evaluation::Options options;
  options.alignment = choice<Alignment>(
      "align", align,
      {{"none", Alignment::kNone}, {"start", Alignment::kStart}, {"se3", Alignment::kSe3}, {"sim3", Alignment::kSim3}});
  options.association.method = choice<AssociationMethod>(
      "associate", associate,
      {{"interpolate", AssociationMethod::kInterpolate}, {"nearest", AssociationMethod::kNearest}});
  constexpr double kMax_s = 1e6;
  if (!(tolerance_s >= 0.0 && tolerance_s <= kMax_s)) {
    throw py::value_error(fmt::format("tolerance_s: expected 0 to {:g}, not {}", kMax_s, tolerance_s));
  }
  options.association.tolerance_ns = std::llround(tolerance_s * 1e9);
  options.segments.lengths_m = segments_m;
  const auto read = estimate_of(estimate);
  evaluation::Report report{"", truth_of(ground_truth), {}};
  std::string json;
  {
    const py::gil_scoped_release release;
    report.evaluations.push_back(evaluation::evaluate(read, report.ground_truth, options));
    json = evaluation::to_json(report);
  }
  // The keys of evaluation.json, so that both have one reference.
  const py::dict document = py::module_::import("json").attr("loads")(json);
  py::dict result = document["estimates"][py::int_(0)];
  const auto& errors = report.evaluations.front().errors;
  py::array_t<double> aligned({static_cast<py::ssize_t>(errors.size()), py::ssize_t{8}});
  double* out = aligned.mutable_data();
  for (const auto& error : errors) {
    *out++ = seconds(error.stamp_ns);
    *out++ = error.distance_m;
    for (const double value : error.translation_m) *out++ = value;
    for (const double value : error.rotation_rad) *out++ = value;
  }
  result["errors"] = aligned;
  return result;
}

}  // namespace

void bind_evaluation(py::module_& module) {
  module.def(
      "evaluate", &evaluate, py::arg("estimate"), py::arg("ground_truth"), py::kw_only(), py::arg("align") = "start",
      py::arg("associate") = "interpolate", py::arg("tolerance_s") = 0.0, py::arg("segments_m") = std::vector<double>(),
      "Compares two trajectories: arrays of N x 8 (stamp_s x y z qx qy qz qw), files (TUM, KITTI, EuRoC) or "
      "folders (run, data set). Returns the figures of `panvo evaluate --json` under the same keys (ate_start_m, "
      "ate_se3_m, rpe_per_frame, rpe_per_metre, segments, ...), None for undefined ones, and errors: M x 8, "
      "stamp_s, distance_m, error x y z (m), rotation error x y z (rad), under `align` (none, start, se3, sim3). "
      "associate: interpolate or nearest; tolerance_s 0: automatic. EvaluationError.");
  module.def(
      "read_trajectory",
      [](const std::filesystem::path& path) {
        const auto trajectory = [&] {
          const py::gil_scoped_release release;
          return evaluation::read_trajectory(path);
        }();
        return to_tum(trajectory);
      },
      py::arg("path"), "Reads a trajectory file or the trajectory of a folder, N x 8. EvaluationError.");
}

}  // namespace panvo::python
