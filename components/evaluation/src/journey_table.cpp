// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "journey_text.hpp"
#include "panvo/evaluation/journey_evaluation.hpp"
#include "panvo/evaluation/paper_figures.hpp"

namespace panvo::evaluation {
namespace {

std::string place_of(const Revisit& revisit) {
  if (!revisit.place) return "elsewhere";
  return std::to_string(*revisit.place) + (revisit.name.empty() ? "" : " " + revisit.name);
}

/// Shortens long routes to both ends: "17-16-..-8-17".
std::string short_route(const std::string& route) {
  constexpr std::size_t kMaxRows = 24;
  if (route.size() <= kMaxRows) return route;
  const auto second = route.find('-', route.find('-') + 1);
  const auto last = route.rfind('-', route.rfind('-') - 1);
  return route.substr(0, second) + "-.." + route.substr(last);
}

std::string result_of(const Revisit& revisit) {
  return std::string(to_string(revisit.result)) + (revisit.is_wrong ? ", WRONG" : "");
}

std::string revisits_text(const RevisitScore& score, const std::string& heading) {
  TextTable table({"no.", "place", "correction", "route", "landmark", "entrance", "binocular", "before", "after",
                   "heading", "->", "own", "beyond", "travelled"},
                  4);
  table.add({"", "", "", "", "", "deg", "m", "m", "m", "deg", "deg", "m", "m", "m"});
  for (const auto& revisit : score.revisits) {
    table.add({std::to_string(revisit.number), place_of(revisit), result_of(revisit), short_route(revisit.route),
               revisit.landmark ? std::to_string(*revisit.landmark) : "-", degrees(revisit.entrance_rad, 0),
               metres(revisit.binocular_m), metres(revisit.before_m), metres(revisit.after_m),
               degrees(revisit.before_heading_rad), degrees(revisit.after_heading_rad), metres(revisit.landmark_m),
               metres(revisit.beyond_m), metres(revisit.travelled_m, 0)});
  }
  std::string text = heading + "\n" + table.text();
  for (const auto& revisit : score.revisits) {
    if (!revisit.reason.empty()) {
      text += fmt::format("  {}: {}: {}\n", revisit.number, to_string(revisit.result), revisit.reason);
    }
  }
  text += fmt::format(
      "  {} revisits: {} corrected, {} in heading only, {} given up, {} rejected, {} missed; {} more elsewhere; {} "
      "corrections applied, {} wrong\n",
      score.listed, score.corrected, score.heading_only, score.given_up, score.rejected, score.missed, score.elsewhere,
      score.applied.size(), score.wrong);
  if (score.not_reached > 0) {
    text += fmt::format("  {} more were not reached: the run covers only part of the recording\n", score.not_reached);
  }
  if (score.before_start > 0) {
    text += fmt::format("  {} outcomes outside the time span of the ground truth were skipped\n", score.before_start);
  }
  return text;
}

std::string compared_text(const JourneyReport& report) {
  TextTable table({"place", "ours", "before", "after", "the paper's", "before", "after"}, 2);
  for (const auto& [ours, papers] : side_by_side(report)) {
    table.add({place_of(*ours), result_of(*ours), metres(ours->before_m), metres(ours->after_m), result_of(*papers),
               metres(papers->before_m), metres(papers->after_m)});
  }
  return "panvo's correction and the paper's own, side by side (m)\n" + table.text();
}

std::string paper_text(bool is_second_journey) {
  TextTable table({"no.", "landmark", "correction", "route", "entrance", "binocular", "enhanced", "travelled"}, 4);
  table.add({"", "", "", "", "deg", "m", "m", "m"});
  for (const auto& row : is_second_journey ? paper::table_4() : paper::table_2()) {
    table.add({std::to_string(row.number), std::to_string(row.landmark), std::string(row.correction),
               std::string(row.route), metres(row.entrance_deg, 0), metres(row.binocular_m, 1),
               metres(row.enhanced_m, 1), metres(row.travelled_m, 0)});
  }
  return fmt::format("Table {} of the paper [Lu2015 7.3], on another campus\n", is_second_journey ? 4 : 2) +
         table.text();
}

std::string stages_text(const std::vector<StageRow>& stages) {
  TextTable table({"item", "stage", "paper", "median", "95 %", "99 %", "count"}, 2);
  table.add({"", "", "ms", "ms", "ms", "ms", ""});
  for (const auto& row : stages) {
    if (row.ours) {
      table.add({row.paper_ms ? row.item : "", row.ours->component + "/" + row.ours->stage, metres(row.paper_ms, 0),
                 metres(row.ours->wall.median_ms), metres(row.ours->wall.p95_ms), metres(row.ours->wall.p99_ms),
                 std::to_string(row.ours->count)});
    } else {
      table.add({row.item, "-", metres(row.paper_ms, 0), "-", "-", "-", "-"});
    }
  }
  return "Time of each stage, compared with Table 3 of the paper\n" + table.text();
}

void add_path(TextTable& table, const std::string& name, const PathScore& path) {
  table.add({name, metres(path.ate_m.rmse), path.ate_se3_m ? metres(path.ate_se3_m->rmse) : "-",
             metres(path.flat_m.rmse), metres(path.flat_m.median), metres(path.percent_of_way, 3),
             turn(path.heading_rad.rmse), metres(path.final_m), metres(path.worst_m), metres(path.worst_at_m, 0)});
}

std::string paths_text(const JourneyReport& report) {
  const auto& paths = report.run.paths;
  TextTable table({"path", "ATE", "ATE, SE3", "2D rms", "2D median", "2D rms", "heading", "final", "largest", "at"}, 1);
  table.add({"", "m", "m", "m", "m", "% of dist.", "deg", "m", "m", "m"});
  add_path(table, "binocular", paths.binocular);
  add_path(table, "enhanced", paths.enhanced);
  if (report.paper_run) add_path(table, "enhanced, the paper's correction", report.paper_run->paths.enhanced);
  auto text = fmt::format("Whole path, {:.0f} m, {:.0f} s, aligned starts, poses as published\n", paths.travelled_m,
                          paths.duration_s) +
              table.text() + fmt::format("  enhanced / binocular, 2D rms: {:.3f}\n", paths.ratio);
  if (paths.unlocated_m > 0.0) {
    text += fmt::format("  not localised for the first {:.0f} m, which the enhanced path is scored without\n",
                        paths.unlocated_m);
  }
  if (const auto& nees = paths.consistency) {
    text += fmt::format(
        "  NEES of the enhanced pose: {:.2f} of {} (x, y, heading), {:.2f} of {} (all); within 95 % bounds: {:.1f} % "
        "and {:.1f} % of the poses; {} poses without a usable covariance\n",
        nees->plane.mean, nees->plane.dimension, nees->full.mean, nees->full.dimension, 100.0 * nees->plane.inside_95,
        100.0 * nees->full.inside_95, nees->unusable);
  }
  return text;
}

std::string azimuth_text(const AzimuthScore& score) {
  if (score.kinds.empty()) return "Azimuth: no episodes of degraded vision known\n";
  TextTable table(
      {"kind", "episodes", "duration", "binocular", "compass", "enhanced", "binocular", "compass", "enhanced"}, 1);
  table.add({"", "", "s", "rms deg", "rms deg", "rms deg", "worst deg", "worst deg", "worst deg"});
  for (const auto& kind : score.kinds) {
    table.add({kind.kind, std::to_string(kind.episodes), metres(kind.duration_s, 1), turn(kind.binocular_rms_rad),
               turn(kind.compass_rms_rad), turn(kind.enhanced_rms_rad), turn(kind.binocular_worst_rad),
               turn(kind.compass_worst_rad), turn(kind.enhanced_worst_rad)});
  }
  return "Change of the azimuth error over episodes of degraded vision [Lu2015 7.2]\n" + table.text();
}

}  // namespace

std::string journey_table(const JourneyReport& report) {
  std::string text = report.title + "\n\n" + paths_text(report) + "\n" +
                     revisits_text(report.run.revisits,
                                   fmt::format("Revisits, as Table {} [Lu2015 7.3]", report.is_second_journey ? 4 : 2));
  if (report.paper_run) {
    text.append("\n").append(compared_text(report));
    text.append("\n").append(
        revisits_text(report.paper_run->revisits, "Revisits with the paper's own correction [Lu2015 5.2]"));
  }
  text.append("\n").append(paper_text(report.is_second_journey));
  text.append("\n").append(stages_text(report.run.stages));
  text.append("\n").append(azimuth_text(report.run.azimuth));
  for (const auto& name : report.run.frames.run.missing) {
    text += "note: " + name + " is missing in the run folder; results that need it are omitted\n";
  }
  return text;
}

}  // namespace panvo::evaluation
