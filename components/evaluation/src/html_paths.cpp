// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "html_sections.hpp"
#include "html_text.hpp"
#include "journey_text.hpp"
#include "svg_chart.hpp"

namespace panvo::evaluation {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Points points_of(const std::vector<PoseError>& errors) {
  Points points;
  for (const auto& error : errors) points.push_back(error.estimate_m.head<2>());
  return points;
}

Points true_points(const RunEvaluation& run) {
  Points points;
  for (const auto& pose : run.frames.recording.truth.poses) {
    points.push_back(pose.world_from_base.translation().head<2>());
  }
  return points;
}

/// The height follows the extent of the paths, limited to the height of a screen.
SvgChart plan_of(const std::vector<const Points*>& paths) {
  Range x{paths.front()->front().x(), paths.front()->front().x()};
  Range y{paths.front()->front().y(), paths.front()->front().y()};
  for (const auto* path : paths) {
    for (const auto& point : *path) {
      x.add(point.x());
      y.add(point.y());
    }
  }
  constexpr double kPlanWidth_px = 1060.0;
  const double height_px = std::clamp(kPlanWidth_px * (y.size() + 1.0) / (x.size() + 1.0), 360.0, 860.0);
  const Box box{0.0, 0.0, kPlanWidth_px, height_px};
  const auto ranges = equal_scale(x, y, box, 0.05);
  return {kPlanWidth_px, height_px, box,
          ranges.x,      ranges.y,  "Plan view of ground truth and both estimated trajectories"};
}

void add_scale(SvgChart& plan, const Points& truth) {
  // At most a fifth of the width: 212 of 1060 px.
  const double m_per_px = 1.0 / (plan.x(1.0) - plan.x(0.0));
  const double length_m = round_number_below(212.0 * m_per_px);
  plan.raw(
      fmt::format("<path class=\"mark\" d=\"M20 24v8h{:.1f}v-8\"/><text class=\"tick\" x=\"{:.1f}\" y=\"28\">{:g} m"
                  "</text>\n",
                  length_m / m_per_px, 28.0 + length_m / m_per_px, length_m));
  plan.dot(truth.front(), 5.0, "end", "start");
  plan.label(truth.front(), 9.0, -8.0, "start", "start", "tick");
}

void add_places(SvgChart& plan, const JourneyRecording& recording) {
  for (const auto& [number, place] : recording.places) {
    const bool is_passed = std::any_of(recording.visits.begin(), recording.visits.end(),
                                       [&, wanted = number](const auto& visit) { return visit.place == wanted; });
    if (!is_passed) continue;
    plan.dot(place.position_m, 9.0, "place", fmt::format("junction {} {}", number, place.name));
    plan.label(place.position_m, 12.0, 14.0, "start", std::to_string(number));
  }
}

void add_landmarks(SvgChart& plan, const RunEvaluation& run) {
  for (const auto& landmark : run.frames.run.landmarks) {
    const Eigen::Vector3d at = (run.frames.world_from_map * landmark.map_from_base).translation();
    plan.dot(at.head<2>(), 4.5, "landmark",
             fmt::format("landmark {}, {}", landmark.id, landmark.is_junction ? "at a junction" : "by distance"));
  }
}

void add_corrections(SvgChart& plan, const RevisitScore& score) {
  for (const auto& applied : score.applied) {
    const std::string wrong = applied.is_wrong ? " wrong" : "";
    const auto tip = fmt::format("after {:.0f} m, landmark {}: error {:.2f} m before, {:.2f} m after",
                                 applied.travelled_m, applied.landmark, applied.before_m, applied.after_m);
    plan.line(applied.before_position_m, applied.after_position_m, "jump" + wrong, tip);
    plan.dot(applied.after_position_m, 4.0, "corrected" + wrong, tip);
  }
}

}  // namespace

std::string paths_section(const JourneyReport& report) {
  const auto& run = report.run;
  const auto truth = true_points(run);
  const auto binocular = points_of(run.paths.binocular.errors);
  const auto enhanced = points_of(run.paths.enhanced.errors);
  auto plan = plan_of({&truth, &binocular, &enhanced});
  add_scale(plan, truth);
  plan.curve(truth, "truth");
  add_places(plan, run.frames.recording);
  plan.curve(binocular, "binocular");
  plan.curve(enhanced, "enhanced");
  add_landmarks(plan, run);
  add_corrections(plan, run.revisits);
  return html_section("Trajectories",
                      "Ground truth and estimated trajectories (Figs. 10 and 11 of the paper). Rings are numbered "
                      "junctions. Hover over a mark for details.",
                      "<figure class=\"plan\">" +
                          legend({{"truth", "ground truth"},
                                  {"binocular", "binocular odometry alone"},
                                  {"enhanced", "enhanced odometry"},
                                  {"dot landmark", "landmark, estimated position"},
                                  {"dot jump", "correction, from before to after"}}) +
                          plan.text() + "</figure>\n");
}

}  // namespace panvo::evaluation
