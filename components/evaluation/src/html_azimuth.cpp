// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "html_sections.hpp"
#include "html_text.hpp"
#include "journey_text.hpp"
#include "svg_chart.hpp"

namespace panvo::evaluation {
namespace {

using Curve = std::vector<AzimuthCurve::Point>;

std::vector<Eigen::Vector2d> curve_in_degrees(const Curve& curve, double AzimuthCurve::Point::*member) {
  std::vector<Eigen::Vector2d> points;
  for (const auto& point : curve) points.emplace_back(point.time_s, point.*member * kDegreesPerRadian);
  return points;
}

std::string diagram(const AzimuthCurve& curve, double AzimuthCurve::Point::*member, const std::string& label) {
  Range x{0.0, static_cast<double>(curve.episode.to_ns - curve.episode.from_ns) * 1e-9};
  const double end_s = x.high;
  Range y{0.0, 0.0};
  const std::vector<std::pair<const Curve*, const char*>> curves{{&curve.truth, "truth"},
                                                                 {&curve.binocular, "binocular"},
                                                                 {&curve.compass, "compass"},
                                                                 {&curve.enhanced, "enhanced"}};
  for (const auto& [points, style] : curves) {
    for (const auto& point : *points) {
      x.add(point.time_s);
      y.add(point.*member * kDegreesPerRadian);
    }
  }
  const double margin = std::max(0.06 * y.size(), 0.1);
  SvgChart chart(1060.0, 260.0, {46.0, 24.0, 1048.0, 218.0}, x, {y.low - margin, y.high + margin}, label);
  chart.band(0.0, end_s, "episode", "the episode");
  chart.grid("time since its start (s)", label);
  for (const auto& [points, style] : curves) chart.curve(curve_in_degrees(*points, member), style);
  return chart.text();
}

std::string table(const AzimuthScore& score) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& kind : score.kinds) {
    rows.push_back({html(kind.kind), std::to_string(kind.episodes), metres(kind.duration_s, 0),
                    turn(kind.binocular_rms_rad), turn(kind.compass_rms_rad), turn(kind.enhanced_rms_rad),
                    turn(kind.binocular_worst_rad), turn(kind.compass_worst_rad), turn(kind.enhanced_worst_rad)});
  }
  return html_table({"kind", "episodes", "duration<br>s", "binocular<br>rms °", "compass<br>rms °", "enhanced<br>rms °",
                     "binocular<br>worst °", "compass<br>worst °", "enhanced<br>worst °"},
                    rows, 1);
}

}  // namespace

std::string azimuth_section(const JourneyReport& report) {
  const auto& run = report.run;
  if (run.azimuth.episodes.empty()) return "";
  auto body = table(run.azimuth);
  if (const auto curve = worst_episode(run.frames, run.azimuth)) {
    const auto& episode = curve->episode;
    body += fmt::format(
        "<figure><p class=\"lead\">Episode with the largest binocular error (Fig. 9 of the paper): {}, after {:.0f} m, "
        "duration {:.1f} s, turn of the vehicle {}°. Heading error: binocular {}°, compass alone {}°, enhanced "
        "{}°.</p>\n",
        html(episode.kind), episode.travelled_m, static_cast<double>(episode.to_ns - episode.from_ns) * 1e-9,
        degrees(episode.turned_rad, 0), degrees(episode.binocular_rad, 2), degrees(episode.compass_rad, 2),
        degrees(episode.enhanced_rad, 2));
    body += legend({{"truth", "ground truth"},
                    {"binocular", "binocular odometry"},
                    {"compass", "panoramic compass alone"},
                    {"enhanced", "enhanced odometry"},
                    {"episode", "the episode"}});
    body += diagram(*curve, &AzimuthCurve::Point::azimuth_rad, "azimuth (°)") +
            diagram(*curve, &AzimuthCurve::Point::error_rad, "azimuth error (°)") + "</figure>\n";
  }
  return html_section(
      "Heading error in degraded-vision segments",
      "Change of the heading error from the start to the end of an episode: unreliable odometry (as it reports), and "
      "movers, illumination changes or weak texture (as listed in the recording).",
      body);
}

}  // namespace panvo::evaluation
