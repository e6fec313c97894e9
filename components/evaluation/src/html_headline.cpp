// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "html_sections.hpp"
#include "html_text.hpp"
#include "journey_text.hpp"

namespace panvo::evaluation {
namespace {

std::string tile(const std::string& figure, const std::string& words) {
  return "<div class=\"tile\"><b>" + figure + "</b><small>" + words + "</small></div>\n";
}

/// About two significant digits.
std::string legible(double value_m) { return metres(value_m, value_m < 1.0 ? 2 : 1); }

std::string what_it_is(const JourneyRecording& recording, const PathScores& paths) {
  constexpr double kFewMinutes_s = 180.0;
  const auto duration = paths.duration_s < kFewMinutes_s ? fmt::format("{:.0f} s", paths.duration_s)
                                                         : fmt::format("{:.0f} min", paths.duration_s / 60.0);
  auto text = fmt::format("{:.0f} m in {}", paths.travelled_m, duration);
  if (!recording.route.empty()) text = "route " + recording.route + ", " + text;
  if (!recording.effects.empty()) text += "; effects: " + joined(recording.effects);
  return text;
}

}  // namespace

std::string page_headline(const JourneyReport& report) {
  const auto& paths = report.run.paths;
  const auto& revisits = report.run.revisits;
  const bool is_better = paths.ratio < 1.0;
  std::string text = "<header>\n<p class=\"kicker\">" + html(report.title) + "</p>\n";
  text += fmt::format(
      "<h1>Error after {:.1f} km: <b class=\"e\">{} m</b> with landmarks, <b class=\"b\">{} m</b> without</h1>\n",
      1e-3 * paths.travelled_m, legible(paths.enhanced.final_m), legible(paths.binocular.final_m));
  text +=
      "<p class=\"lead\">" + html(what_it_is(report.run.frames.recording, paths)) +
      (paths.unlocated_m > 0.0
           ? fmt::format(
                 ". Not localised for the first {:.0f} m (reported as such); the enhanced path is scored from then on",
                 paths.unlocated_m)
           : std::string()) +
      ". All figures are for poses as published, with aligned starts, without smoothing or later alignment.</p>\n<div "
      "class=\"tiles\">\n";
  text += tile(metres(paths.enhanced.flat_m.rmse) + " m",
               fmt::format("2D rms error; binocular odometry alone: {} m", metres(paths.binocular.flat_m.rmse)));
  text += tile(fmt::format("{:.1f} %", 100.0 * paths.ratio),
               is_better ? "of the binocular 2D rms error" : "of the binocular 2D rms error (worse)");
  text +=
      tile(metres(paths.enhanced.percent_of_way, 3) + " %",
           "2D rms error over the distance travelled; binocular: " + metres(paths.binocular.percent_of_way, 3) + " %");
  text += tile(fmt::format("{} of {}", revisits.corrected + revisits.heading_only, revisits.listed),
               fmt::format("listed revisits corrected the pose; {} given up, {} rejected, {} missed{}",
                           revisits.given_up, revisits.rejected, revisits.missed, elsewhere_words(revisits)));
  text += tile(fmt::format("<span class=\"{}\">{}</span>", revisits.wrong == 0 ? "good" : "bad", revisits.wrong),
               fmt::format("of {} applied corrections wrong", revisits.applied.size()));
  text += tile(turn(paths.enhanced.heading_rad.rmse) + "°",
               "rms heading error; binocular: " + turn(paths.binocular.heading_rad.rmse) + "°");
  text += tile(metres(paths.enhanced.worst_m) + " m",
               fmt::format("largest error, after {:.0f} m; binocular: {} m", paths.enhanced.worst_at_m,
                           metres(paths.binocular.worst_m)));
  if (paths.consistency) {
    text +=
        tile(fmt::format("{:.0f} %", 100.0 * paths.consistency->plane.inside_95),
             fmt::format("of the poses within their 95 % bound; mean NEES {:.1f} of 3", paths.consistency->plane.mean));
  }
  return text + "</div>\n</header>\n";
}

}  // namespace panvo::evaluation
