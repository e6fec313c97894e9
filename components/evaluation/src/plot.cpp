// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/plot.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "format.hpp"
#include "gnuplot.hpp"
#include "plot_canvas.hpp"
#include "plot_panels.hpp"

namespace panvo::evaluation {
namespace {

constexpr double kLegendTopPx = 104.0;
constexpr double kLegendRowPx = 30.0;
constexpr double kBodyPx = 1340.0;

std::string aligned_by(Alignment alignment) {
  switch (alignment) {
    case Alignment::kNone:
      return "nothing";
    case Alignment::kStart:
      return "the first pose";
    case Alignment::kSe3:
      return "SE3";
    case Alignment::kSim3:
      return "Sim3";
  }
  return "";
}

std::string headline(const Evaluation& e) {
  std::string text = e.name + ": ";
  if (e.ate_se3_m) text += "ATE " + to_text(e.ate_se3_m->rmse, 3) + " m rmse after SE3, ";
  if (e.ate_start_m) text += to_text(e.ate_start_m->rmse, 3) + " m from the start; ";
  if (e.end_error_percent) text += "end " + to_text(*e.end_error_percent, 2) + " % of the path; ";
  if (e.segments) {
    text += "segments " + to_text(e.segments->translation_percent, 2) + " %, " +
            to_text(e.segments->rotation_deg_per_m, 4) + " deg/m; ";
  }
  if (e.nees) {
    const ConsistencyOptions& options = e.nees->options;
    const bool noisy = options.truth_noise_m > 0.0 || options.truth_noise_rad > 0.0;
    text += "NEES " + to_text(e.nees->motion.mean, 1) + " of 6" + (noisy ? " with ground-truth noise; " : "; ");
  }
  return text.substr(0, text.size() - 2);
}

// Title, and one line each for ground truth and estimates: the legend of all panels with key figures.
void add_heading(PlotCanvas& canvas, const Report& report) {
  const auto legend = [&](std::size_t row, const std::string& text, const std::string& mark) {
    canvas.line("set label " + std::to_string(2 + row) + " " + gnuplot_quoted(text) + " " +
                canvas.at_screen(50, kLegendTopPx + kLegendRowPx * static_cast<double>(row)) + " left point pt 5" +
                mark_size(2) + " lc " + mark + " offset 1.6,0" + ink());
  };
  canvas.line("set label 1 " + gnuplot_quoted(report.title) + " " + canvas.at_screen(40, 46) + " left" + bold(24) +
              ink());
  const Evaluation& first = report.evaluations.front();
  legend(0,
         "ground truth: " + to_text(first.path_length_m, 1) + " m, " + to_text(first.duration_s, 1) +
             " s; errors aligned by " + aligned_by(first.alignment),
         std::string("rgb '") + kTruthColour + "'");
  for (std::size_t i = 0; i < report.evaluations.size(); ++i) {
    legend(1 + i, headline(report.evaluations[i]), colour(i));
  }
  // gnuplot draws labels with the next plot; an invisible plot draws these.
  canvas.line("set lmargin 0; set rmargin 0; set tmargin 0; set bmargin 0; unset border; unset tics");
  canvas.line("plot [0:1] [0:1] NaN");
}

void add_page(PlotCanvas& canvas, const Report& report) {
  canvas.line("reset; set multiplot; unset key");
  add_heading(canvas, report);
  canvas.line(std::string("set border 3 lc rgb '") + kSoft + "'; set tics nomirror out scale 0.4" + ink() +
              "; set grid lt 1 lw 1 lc rgb '" + kGridColour + "'");
  add_plan(canvas, report, {122, 40, 870, 660});
  add_error_over_distance(canvas, report, {1022, 40, 1760, 270});
  add_segments(canvas, report, {1022, 390, 1345, 660}, "Segments: translation", "error (%)",
               {&SegmentError::translation_percent, 2, 1.0});
  add_segments(canvas, report, {1472, 390, 1760, 660}, "Segments: rotation", "error (deg/100 m)",
               {&SegmentError::rotation_deg_per_m, 3, 100.0});
  const auto timed = std::find_if(report.evaluations.begin(), report.evaluations.end(),
                                  [](const Evaluation& e) { return e.timing && !e.timing->empty(); });
  const bool with_times = timed != report.evaluations.end();
  add_error_strips(canvas, report, {122, 790, with_times ? 870.0 : 1760.0, 1260});
  if (with_times) add_times(canvas, *timed->timing, {1300, 790, 1760, 1260});
  canvas.line("unset multiplot");
}

// Stereo odometry and enhanced odometry have their colours in the report of a journey; others take the next ones that
// are free.
std::string colour_variables(const Report& report) {
  std::vector<std::size_t> taken;
  const auto is_free = [&](std::size_t index) { return std::find(taken.begin(), taken.end(), index) == taken.end(); };
  std::vector<std::optional<std::size_t>> colours;
  for (const auto& evaluation : report.evaluations) {
    const bool is_enhanced = evaluation.name.find("enhanced") != std::string::npos;
    const bool is_binocular = evaluation.name.find("binocular") != std::string::npos;
    const std::size_t own = is_enhanced ? 0 : 1;
    const bool has_own = (is_enhanced || is_binocular) && is_free(own);
    colours.push_back(has_own ? std::optional(own) : std::nullopt);
    if (has_own) taken.push_back(own);
  }
  std::string text;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    for (std::size_t next = 0; !colours[i] && next < kColours.size(); ++next) {
      if (is_free(next)) colours[i] = next;
    }
    const std::size_t index = colours[i].value_or(i % kColours.size());  // more estimates than colours: also by dashes
    taken.push_back(index);
    text += "colour" + std::to_string(i) + " = '" + kColours[index] + "'\n";
  }
  return text;
}

}  // namespace

std::string plot_script(const Report& report) {
  const double body_top_px = kLegendTopPx + kLegendRowPx * static_cast<double>(report.evaluations.size() + 1);
  const double height_px = body_top_px + kBodyPx;
  PlotCanvas data(body_top_px, height_px);
  add_data(data, report);
  PlotCanvas page(body_top_px, height_px);
  add_page(page, report);
  const std::string size = "size " + number(kWidthPx) + "," + number(height_px);
  const std::string common = std::string(" noenhanced font '") + kFont + ",14' background rgb 'white'\n";
  // The terminals differ in the size of fonts and marks, and only cairo selects a bold face by name.
  const std::string png = "set terminal pngcairo " + size + common + "bold = '" + kFont + ":Bold'; marks = 1\n";
  const std::string svg =
      "set terminal svg " + size + " dynamic fontscale 1.3" + common + "bold = '" + kFont + "'; marks = 0.6\n";
  return "# Drawn by panvo evaluate. To redraw, run `gnuplot -d evaluation.gp` in this folder.\nset encoding utf8\n" +
         colour_variables(report) + data.text() + png + "set output 'evaluation.png'\n" + page.text() + svg +
         "set output 'evaluation.svg'\n" + page.text() + "unset output\n";
}

void draw_plot(const Report& report, const std::filesystem::path& folder) {
  constexpr const char* kScript = "evaluation.gp";
  std::ofstream stream(folder / kScript, std::ios::binary);
  if (!(stream << plot_script(report)).flush()) {
    throw PlotError((folder / kScript).string() + ": cannot be written; choose a writable folder");
  }
  stream.close();
  run_gnuplot(folder, kScript);
}

}  // namespace panvo::evaluation
