// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "format.hpp"
#include "panvo/evaluation/report.hpp"

namespace panvo::evaluation {
namespace {

constexpr std::string_view kGap = "  ";

using Cell = std::optional<std::string>;

Cell cell(const std::optional<double>& value, int digits) {
  return value ? Cell(to_text(*value, digits)) : std::nullopt;
}

// Rows of a label, a unit and one value per estimate; a row without values is a section heading.
class Table {
 public:
  explicit Table(const std::vector<Evaluation>& evaluations) : evaluations_(evaluations) {}

  void section(const std::string& heading) { rows_.push_back({heading, "", {}}); }

  // An `optional` row is omitted if no estimate has a value.
  void row(const std::string& label, const std::string& unit, const std::function<Cell(const Evaluation&)>& value,
           bool optional = false) {
    Row row{"  " + label, unit, {}};
    bool any = false;
    for (const Evaluation& evaluation : evaluations_) {
      const Cell text = value(evaluation);
      any = any || text;
      row.values.push_back(text.value_or("-"));
    }
    if (any || !optional) rows_.push_back(std::move(row));
  }

  void summary(const std::string& label, const std::string& unit, int digits,
               const std::function<std::optional<Summary>(const Evaluation&)>& summary) {
    const auto part = [&](const char* name, double Summary::*member) {
      row(label + name, unit, [&, member](const Evaluation& e) {
        const auto values = summary(e);
        return values ? Cell(to_text((*values).*member, digits)) : std::nullopt;
      });
    };
    part("rmse", &Summary::rmse);
    part("mean", &Summary::mean);
    part("median", &Summary::median);
    part("max", &Summary::max);
  }

  std::string text() const {
    std::size_t label_width = 0;
    std::size_t unit_width = 0;
    std::vector<std::size_t> widths;
    for (const Evaluation& evaluation : evaluations_) widths.push_back(evaluation.name.size());
    for (const Row& row : rows_) {
      if (!row.values.empty()) label_width = std::max(label_width, row.label.size());
      unit_width = std::max(unit_width, row.unit.size());
      for (std::size_t i = 0; i < row.values.size(); ++i) widths[i] = std::max(widths[i], row.values[i].size());
    }
    std::string text = padded("", label_width) + std::string(kGap) + padded("", unit_width);
    for (std::size_t i = 0; i < widths.size(); ++i) {
      text += std::string(kGap) + padded(evaluations_[i].name, widths[i], true);
    }
    text += "\n";
    for (const Row& row : rows_) {
      if (row.values.empty()) {
        text += row.label + "\n";
        continue;
      }
      text += padded(row.label, label_width) + std::string(kGap) + padded(row.unit, unit_width);
      for (std::size_t i = 0; i < widths.size(); ++i)
        text += std::string(kGap) + padded(row.values[i], widths[i], true);
      text += "\n";
    }
    return text;
  }

 private:
  struct Row {
    std::string label;
    std::string unit;
    std::vector<std::string> values;
  };

  static std::string padded(const std::string& text, std::size_t width, bool right = false) {
    const std::string blanks(width - std::min(width, text.size()), ' ');
    return right ? blanks + text : text + blanks;
  }

  const std::vector<Evaluation>& evaluations_;
  std::vector<Row> rows_;
};

void add_coverage(Table& table) {
  table.section("compared");
  table.row("poses with ground truth", "",
            [](const Evaluation& e) { return std::to_string(e.pairs) + "/" + std::to_string(e.poses); });
  table.row(
      "frames without a measured motion", "",
      [](const Evaluation& e) { return e.unreliable ? Cell(std::to_string(*e.unreliable)) : std::nullopt; }, true);
  table.row("duration", "s", [](const Evaluation& e) { return to_text(e.duration_s, 1); });
  table.row("path length", "m", [](const Evaluation& e) { return to_text(e.path_length_m, 1); });
  table.row("part of the ground truth", "%", [](const Evaluation& e) { return to_text(e.coverage_percent, 1); });
}

void add_absolute(Table& table) {
  table.section("absolute trajectory error, aligned at the start");
  table.summary("", "m", 3, [](const Evaluation& e) { return e.ate_start_m; });
  table.row("rotation rmse", "deg", [](const Evaluation& e) {
    return e.rotation_start_deg ? Cell(to_text(e.rotation_start_deg->rmse, 3)) : std::nullopt;
  });
  table.row("at the end", "m", [](const Evaluation& e) { return cell(e.end_error_m, 3); });
  table.row("at the end, relative to path length", "%",
            [](const Evaluation& e) { return cell(e.end_error_percent, 3); });
  table.row("rotation at the end", "deg", [](const Evaluation& e) { return cell(e.end_rotation_deg, 3); });
  table.section("absolute trajectory error, aligned by SE3");
  table.summary("", "m", 3, [](const Evaluation& e) { return e.ate_se3_m; });
  table.row("scale error by Sim3", "%", [](const Evaluation& e) { return cell(e.scale_error_percent, 3); });
}

void add_relative(Table& table, const std::vector<Evaluation>& evaluations) {
  table.section("KITTI segments");
  table.row("translation, all", "%", [](const Evaluation& e) {
    return e.segments ? Cell(to_text(e.segments->translation_percent, 3)) : std::nullopt;
  });
  table.row("rotation, all", "deg/m", [](const Evaluation& e) {
    return e.segments ? Cell(to_text(e.segments->rotation_deg_per_m, 5)) : std::nullopt;
  });
  // Estimates that cover different parts of the path may have different lengths; they are distinguished to 1 mm.
  std::map<std::int64_t, double> lengths;
  for (const Evaluation& e : evaluations) {
    if (!e.segments) continue;
    for (const SegmentError& s : e.segments->by_length) lengths.emplace(std::llround(s.length_m * 1e3), s.length_m);
  }
  for (const auto& [key, length] : lengths) {
    const std::string label = "translation, " + to_text(length, 3, std::chars_format::general) + " m";
    table.row(label, "%", [key = key](const Evaluation& e) -> Cell {
      if (!e.segments) return std::nullopt;
      for (const SegmentError& s : e.segments->by_length) {
        if (std::llround(s.length_m * 1e3) == key) return to_text(s.translation_percent, 3);
      }
      return std::nullopt;
    });
  }
  table.section("relative pose error, rmse");
  const auto relative = [&](const char* label, const char* unit, int digits,
                            std::optional<RelativePoseError> Evaluation::*error, Summary RelativePoseError::*part) {
    table.row(label, unit, [=](const Evaluation& e) {
      return e.*error ? Cell(to_text(((*(e.*error)).*part).rmse, digits)) : std::nullopt;
    });
  };
  relative("translation per frame", "m", 4, &Evaluation::per_frame, &RelativePoseError::translation);
  relative("rotation per frame", "deg", 4, &Evaluation::per_frame, &RelativePoseError::rotation_deg);
  relative("translation per metre", "m/m", 4, &Evaluation::per_metre, &RelativePoseError::translation);
  relative("rotation per metre", "deg/m", 4, &Evaluation::per_metre, &RelativePoseError::rotation_deg);
}

std::string truth_noise_of(const ConsistencyOptions& options) {
  if (options.truth_noise_m == 0.0 && options.truth_noise_rad == 0.0) return "";
  return ", noise of the ground truth " + to_text(options.truth_noise_m, 4) + " m and " +
         to_text(options.truth_noise_rad * 180.0 / std::numbers::pi, 4) + " deg";
}

void add_consistency(Table& table, const std::vector<Evaluation>& evaluations) {
  const auto with_nees = std::find_if(evaluations.begin(), evaluations.end(), [](const auto& e) { return e.nees; });
  if (with_nees == evaluations.end()) return;
  const std::size_t steps = with_nees->nees->options.steps;
  table.section("normalised estimation error squared of the motion over " + std::to_string(steps) +
                (steps == 1 ? " step" : " steps") + truth_noise_of(with_nees->nees->options));
  const auto row = [&](const char* label, Nees Consistency::*part) {
    table.row(label, "",
              [=](const Evaluation& e) { return e.nees ? Cell(to_text(((*e.nees).*part).mean, 2)) : std::nullopt; });
  };
  row("mean, 6 expected", &Consistency::motion);
  table.row("95 % bounds of the mean", "", [](const Evaluation& e) {
    return e.nees ? Cell(to_text(e.nees->motion.lower_95, 2) + ".." + to_text(e.nees->motion.upper_95, 2))
                  : std::nullopt;
  });
  row("translation, 3 expected", &Consistency::motion_translation);
  row("rotation, 3 expected", &Consistency::motion_rotation);
  table.row("accumulated pose, 6 expected", "", [](const Evaluation& e) {
    return e.nees && e.nees->pose ? Cell(to_text(e.nees->pose->mean, 2)) : std::nullopt;
  });
  table.row("intervals used", "", [](const Evaluation& e) {
    return e.nees ? Cell(std::to_string(e.nees->motion.samples) + "/" +
                         std::to_string(e.nees->motion.samples + e.nees->unusable))
                  : std::nullopt;
  });
}

void add_stage_times(Table& table, const std::vector<Evaluation>& evaluations) {
  std::vector<std::string> stages;  // in the order of first appearance
  for (const Evaluation& e : evaluations) {
    if (!e.timing) continue;
    for (const StageTime& time : *e.timing) {
      const std::string name = time.component + "/" + time.stage;
      if (std::find(stages.begin(), stages.end(), name) == stages.end()) stages.push_back(name);
    }
  }
  if (stages.empty()) return;
  table.section("time of each stage, wall mean / p95, CPU mean");
  for (const std::string& stage : stages) {
    table.row(stage, "ms", [&](const Evaluation& e) -> Cell {
      if (!e.timing) return std::nullopt;
      for (const StageTime& time : *e.timing) {
        if (time.component + "/" + time.stage != stage) continue;
        return to_text(time.wall.mean_ms, 2) + " / " + to_text(time.wall.p95_ms, 2) + ", " +
               to_text(time.cpu.mean_ms, 2);
      }
      return std::nullopt;
    });
  }
}

std::string describe_association(const Evaluation& evaluation) {
  const bool interpolated = evaluation.association == AssociationMethod::kInterpolate;
  return std::string(interpolated ? "interpolated at the estimate's stamps, over gaps up to "
                                  : "the pose nearest in time, within ") +
         to_text(static_cast<double>(evaluation.tolerance_ns) * 1e-6, 1) + " ms (largest difference " +
         to_text(static_cast<double>(evaluation.max_difference_ns) * 1e-6, 1) + " ms)";
}

}  // namespace

std::string to_table(const Report& report) {
  Table table(report.evaluations);
  add_coverage(table);
  add_absolute(table);
  add_relative(table, report.evaluations);
  add_consistency(table, report.evaluations);
  add_stage_times(table, report.evaluations);
  const Trajectory& truth = report.ground_truth;
  return report.title + "\nground truth: " + truth.source.string() + " (" + truth.format + ", " +
         std::to_string(truth.poses.size()) + " poses, " + to_text(path_length_m(truth), 1) + " m), " +
         describe_association(report.evaluations.front()) + "\n\n" + table.text();
}

}  // namespace panvo::evaluation
