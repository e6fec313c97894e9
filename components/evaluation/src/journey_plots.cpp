// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "gnuplot.hpp"
#include "journey_text.hpp"
#include "panvo/evaluation/journey_evaluation.hpp"
#include "plot_canvas.hpp"

namespace panvo::evaluation {
namespace {

constexpr std::size_t kMaxRows = 4000;

std::string head(const std::string& file, int width_px, int height_px, const std::string& title) {
  return fmt::format(
      "set terminal pngcairo noenhanced size {},{} font 'sans,11'\nset output '{}'\nset title {}\nset grid lc rgb "
      "'{}'\nset key "
      "outside bottom center horizontal\nset bmargin 5.5\n",
      width_px, height_px, file, gnuplot_quoted(title), kGridColour);
}

template <class Rows, class Write>
std::string data_block(const std::string& name, const Rows& rows, const Write& write) {
  std::string text = fmt::format("${} << E\n", name);
  const std::size_t stride = rows.size() / kMaxRows + 1;
  for (std::size_t i = 0; i < rows.size(); i += stride) text += write(rows[i]) + "\n";
  if (rows.empty()) text += "NaN NaN\n";  // gnuplot needs at least one row
  return text + "E\n";
}

std::string place_row(const PoseError& error) {
  return fmt::format("{:.3f} {:.3f}", error.estimate_m.x(), error.estimate_m.y());
}

std::string error_row(const PoseError& error) {
  return fmt::format("{:.2f} {:.4f}", error.distance_m, error.translation_m.head<2>().norm());
}

std::string landmark_rows(const RunEvaluation& run) {
  return data_block("landmarks", run.frames.run.landmarks, [&](const RunLandmark& landmark) {
    const Eigen::Vector3d at = (run.frames.world_from_map * landmark.map_from_base).translation();
    return fmt::format("{:.3f} {:.3f}", at.x(), at.y());
  });
}

/// Trajectories over ground truth [Lu2015 Figs. 10 and 11].
std::string paths_script(const JourneyReport& report) {
  const auto& run = report.run;
  return head("journey_paths.png", 1100, 900, report.title) +
         "set size ratio -1\nset xlabel 'x (m)'\nset ylabel 'y (m)'\n" +
         data_block("truth", run.frames.recording.truth.poses,
                    [](const StampedPose& pose) {
                      const auto at = pose.world_from_base.translation();
                      return fmt::format("{:.3f} {:.3f}", at.x(), at.y());
                    }) +
         data_block("binocular", run.paths.binocular.errors, place_row) +
         data_block("enhanced", run.paths.enhanced.errors, place_row) + landmark_rows(run) +
         data_block("corrections", run.revisits.applied,
                    [](const AppliedCorrection& applied) {
                      return fmt::format("{:.3f} {:.3f} {:.3f} {:.3f}", applied.before_position_m.x(),
                                         applied.before_position_m.y(),
                                         applied.after_position_m.x() - applied.before_position_m.x(),
                                         applied.after_position_m.y() - applied.before_position_m.y());
                    }) +
         fmt::format(
             "plot $truth with lines lw 7 lc rgb '{}' title 'ground truth', $binocular with lines lw 2 lc rgb '{}' "
             "title 'binocular', $enhanced with lines lw 2 lc rgb '{}' title 'enhanced', $landmarks with points pt 7 "
             "ps 0.9 "
             "lc rgb '{}' title 'landmarks', $corrections using 1:2:3:4 with vectors lw 1.5 lc rgb '{}' title "
             "'corrections'\n",
             kTruthColour, kColours[1], kColours[0], kColours[4], kColours[2]);
}

std::string error_script(const JourneyReport& report) {
  const auto& run = report.run;
  return head("journey_error.png", 1100, 480, "Horizontal error over distance travelled") +
         "set xlabel 'distance travelled (m)'\nset ylabel 'error (m)'\nset yrange [0:*]\n" +
         data_block("binocular", run.paths.binocular.errors, error_row) +
         data_block("enhanced", run.paths.enhanced.errors, error_row) +
         data_block("corrections", run.revisits.applied,
                    [](const AppliedCorrection& applied) {
                      return fmt::format("{:.2f} {:.4f}", applied.travelled_m, applied.after_m);
                    }) +
         fmt::format(
             "plot $binocular with lines lw 2 lc rgb '{}' title 'binocular', $enhanced with lines lw 2 lc rgb '{}' "
             "title "
             "'enhanced', $corrections with points pt 7 ps 1 lc rgb '{}' title 'corrected'\n",
             kColours[1], kColours[0], kColours[2]);
}

/// Azimuth and azimuth error during one episode [Lu2015 Fig. 9].
std::string azimuth_script(const AzimuthCurve& curve) {
  const auto row = [](const AzimuthCurve::Point& point) {
    return fmt::format("{:.3f} {:.4f} {:.4f}", point.time_s, point.azimuth_rad * kDegreesPerRadian,
                       point.error_rad * kDegreesPerRadian);
  };
  const double length_s = static_cast<double>(curve.episode.to_ns - curve.episode.from_ns) * 1e-9;
  std::string script =
      head("journey_azimuth.png", 1100, 640, fmt::format("Azimuth during an episode: {}", curve.episode.kind)) +
      data_block("truth", curve.truth, row) + data_block("binocular", curve.binocular, row) +
      data_block("compass", curve.compass, row) + data_block("enhanced", curve.enhanced, row) +
      fmt::format("set object 1 rect from 0,graph 0 to {:.3f},graph 1 fc rgb '{}' behind fs solid noborder\n", length_s,
                  kGridColour) +
      "set multiplot layout 2,1\nset ylabel 'azimuth (deg)'\n";
  const auto curves = [](int column) {
    return fmt::format(
        "$binocular using 1:{0} with lines lw 2 lc rgb '{1}' title 'binocular', $compass using 1:{0} with lines lw 2 "
        "lc rgb '{2}' title 'compass alone', $enhanced using 1:{0} with lines lw 2 lc rgb '{3}' title 'enhanced'\n",
        column, kColours[1], kColours[2], kColours[0]);
  };
  script +=
      fmt::format("plot $truth using 1:2 with lines lw 7 lc rgb '{}' title 'ground truth', ", kTruthColour) + curves(2);
  return script + "unset title\nset xlabel 'time since the start (s)'\nset ylabel 'error (deg)'\nplot " + curves(3) +
         "unset multiplot\n";
}

}  // namespace

void draw_journey(const JourneyReport& report, const std::filesystem::path& folder) {
  write_and_run_gnuplot(folder, "journey_paths.gp", paths_script(report));
  write_and_run_gnuplot(folder, "journey_error.gp", error_script(report));
  if (const auto curve = worst_episode(report.run.frames, report.run.azimuth)) {
    write_and_run_gnuplot(folder, "journey_azimuth.gp", azimuth_script(*curve));
  }
}

}  // namespace panvo::evaluation
