// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "html_sections.hpp"
#include "html_text.hpp"
#include "journey_text.hpp"
#include "svg_chart.hpp"

namespace panvo::evaluation {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr double kWidth_px = 1060.0;

Points over_distance(const std::vector<PoseError>& errors) {
  Points points;
  for (const auto& error : errors) points.emplace_back(error.distance_m, error.translation_m.head<2>().norm());
  return points;
}

double highest(const Points& points) {
  double high = 0.0;
  for (const auto& point : points) high = std::max(high, point.y());
  return high;
}

SvgChart chart(double height_px, double travelled_m, double high, const std::string& description) {
  return {
      kWidth_px,       height_px,  {46.0, 24.0, kWidth_px - 12.0, height_px - 42.0}, {0.0, std::max(travelled_m, 1.0)},
      from_zero(high), description};
}

/// Twice the standard deviation reported by the localizer.
Points own_bound(const RunEvaluation& run) {
  const TruePath truth(run.frames.recording.truth);
  Points points;
  for (const auto& state : run.frames.run.states) {
    if (!state.position_sigma_m || !truth.pose(state.stamp_ns)) continue;
    points.emplace_back(truth.travelled_m(state.stamp_ns), 2.0 * *state.position_sigma_m);
  }
  return points;
}

/// Largest value of the second chart: the error, and the bound unless it is far larger, as while the start is unknown.
double highest_shown(const Points& enhanced, const Points& bound) {
  constexpr double kFarLarger = 4.0;
  return std::max(highest(enhanced), std::min(highest(bound), kFarLarger * highest(enhanced)));
}

/// Points above the chart are drawn at its border.
void mark_corrections(SvgChart& chart, const RevisitScore& score, double highest_m) {
  for (const auto& applied : score.applied) {
    const std::string wrong = applied.is_wrong ? " wrong" : "";
    const auto tip = fmt::format(
        "after {:.0f} m, landmark {}: {:.2f} m before, {:.2f} m after{}", applied.travelled_m, applied.landmark,
        applied.before_m, applied.after_m,
        applied.landmark_m ? fmt::format("; error of the landmark: {:.2f} m", *applied.landmark_m) : std::string());
    chart.line({applied.travelled_m, std::min(applied.before_m, highest_m)},
               {applied.travelled_m, std::min(applied.after_m, highest_m)}, "jump" + wrong, tip);
    chart.dot({applied.travelled_m, std::min(applied.before_m, highest_m)}, 3.0, "before", tip);
    chart.dot({applied.travelled_m, std::min(applied.after_m, highest_m)}, 4.0, "corrected" + wrong, tip);
  }
  for (const auto& revisit : score.revisits) {
    if (revisit.corrections > 0 || !revisit.before_m) continue;
    chart.dot({revisit.travelled_m, std::min(*revisit.before_m, highest_m)}, 4.0, "missed",
              fmt::format("{} {}: {}", to_string(revisit.result), revisit.name, revisit.reason));
  }
}

}  // namespace

std::string error_section(const JourneyReport& report) {
  const auto& run = report.run;
  const auto binocular = over_distance(run.paths.binocular.errors);
  const auto enhanced = over_distance(run.paths.enhanced.errors);
  auto both = chart(300.0, run.paths.travelled_m, std::max(highest(binocular), highest(enhanced)),
                    "Horizontal error of both odometries over the distance travelled");
  both.grid("distance travelled (m)", "error (m)");
  both.curve(binocular, "binocular");
  both.curve(enhanced, "enhanced");

  auto bound = own_bound(run);
  const double high_m = highest_shown(enhanced, bound);
  auto close =
      chart(340.0, run.paths.travelled_m, high_m, "Horizontal error of the enhanced odometry, with its corrections");
  close.grid("distance travelled (m)", "error (m)");
  const double top_m = from_zero(high_m).high;
  for (auto& point : bound) point.y() = std::min(point.y(), top_m);
  close.curve(bound, "sigma");
  if (report.paper_run) {
    auto papers = over_distance(report.paper_run->paths.enhanced.errors);
    for (auto& point : papers) point.y() = std::min(point.y(), top_m);
    close.curve(papers, "paper");
  }
  close.curve(enhanced, "enhanced");
  mark_corrections(close, run.revisits, top_m);
  std::vector<std::pair<std::string, std::string>> keys{{"enhanced", "enhanced odometry"},
                                                        {"sigma", "its 2 sigma bound"},
                                                        {"dot jump", "correction, from before (ring) to after"},
                                                        {"dot missed", "revisit without correction"}};
  if (report.paper_run) keys.emplace_back("paper", "with the paper's own correction");
  return html_section("Error over the distance travelled",
                      "Horizontal error. Odometry accumulates errors; a recognised place removes the error accumulated "
                      "since its first visit. Second chart: the enhanced odometry alone, on its own scale.",
                      "<figure>" +
                          legend({{"binocular", "binocular odometry alone"}, {"enhanced", "enhanced odometry"}}) +
                          both.text() + "</figure>\n<figure>" + legend(keys) + close.text() + "</figure>\n");
}

}  // namespace panvo::evaluation
