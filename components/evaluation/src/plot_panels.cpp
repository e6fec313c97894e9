// SPDX-License-Identifier: Apache-2.0
#include "plot_panels.hpp"

#include <algorithm>
#include <numbers>
#include <set>

#include "angle_units.hpp"
#include "format.hpp"
#include "gnuplot.hpp"

namespace panvo::evaluation {
namespace {

constexpr std::size_t kMaxStages = 14;
constexpr std::size_t kMaxLengths = 8;

// Centimetres for small errors, else metres.
struct LengthUnit {
  const char* name;
  double per_m;
};

LengthUnit error_unit(const Report& report) {
  constexpr double kMaxInCentimetresM = 0.5;
  double max_m = 0.0;
  for (const Evaluation& e : report.evaluations) {
    for (const PoseError& error : e.errors) max_m = std::max(max_m, error.translation_m.norm());
  }
  return max_m < kMaxInCentimetresM ? LengthUnit{"cm", 100.0} : LengthUnit{"m", 1.0};
}

// `column` of a data block, times `factor`.
std::string scaled(int column, double factor) {
  return std::string("($") + std::to_string(column) + "*" + number(factor) + ")";
}

std::string shortened(const std::string& name) {
  constexpr std::size_t kMaxLength = 38;
  constexpr std::size_t kEnd = 17;
  if (name.size() <= kMaxLength) return name;
  return name.substr(0, kMaxLength - kEnd - 2) + ".." + name.substr(name.size() - kEnd);
}

std::string rectangle(double from_y, double to_y, double length, const char* fill) {
  return " rectangle from 0," + number(from_y) + " to " + number(length) + "," + number(to_y) + " fillcolor rgb '" +
         fill + "' fillstyle solid noborder front";
}

}  // namespace

void add_error_over_distance(PlotCanvas& canvas, const Report& report, const Box& box) {
  const LengthUnit unit = error_unit(report);
  canvas.panel(box, "Translation error over distance travelled", "distance (m)",
               std::string("error (") + unit.name + ")");
  double highest = 0.0;
  std::string plot;
  for (std::size_t i = 0; i < report.evaluations.size(); ++i) {
    for (const PoseError& error : report.evaluations[i].errors) {
      highest = std::max(highest, unit.per_m * error.translation_m.norm());
    }
    plot += (i == 0 ? "plot " : ", ") + block("errors", i) + " using 2:" + scaled(5, unit.per_m) + " with lines " +
            curve(i, 2.5);
  }
  canvas.y_from_zero(highest);
  canvas.line("set xrange [0:*] noextend").line(plot);
}

void add_segments(PlotCanvas& canvas, const Report& report, const Box& box, const std::string& title,
                  const std::string& y_label, const SegmentValue& value) {
  canvas.panel(box, title, "length (m)", y_label);
  double highest = 0.0;
  std::set<double> lengths;
  std::string plot;
  for (std::size_t i = 0; i < report.evaluations.size(); ++i) {
    if (!report.evaluations[i].segments) continue;
    for (const SegmentError& segment : report.evaluations[i].segments->by_length) {
      lengths.insert(segment.length_m);
      highest = std::max(highest, value.factor * segment.*value.member);
    }
    plot += (plot.empty() ? "plot " : ", ") + block("segments", i) + " using 1:" + scaled(value.column, value.factor) +
            " with linespoints pt 7" + mark_size(1.2) + " " + curve(i);
  }
  if (plot.empty()) {
    canvas.line("set xrange [0:1]; set yrange [0:1]; set xtics ('' 0); set ytics ('' 0); set label 101 " +
                gnuplot_quoted("no segment fits the path") + " at graph 0.5, graph 0.5 center" + ink());
    canvas.line("plot NaN");
    return;
  }
  canvas.y_from_zero(highest);
  canvas.line("set xrange [0:" + number(1.08 * *lengths.rbegin()) + "]");
  if (lengths.size() <= kMaxLengths) {
    std::string ticks;
    for (const double length : lengths) {
      ticks += (ticks.empty() ? "'" : ", '") + to_text(length, 3, std::chars_format::general) + "' " + number(length);
    }
    canvas.line("set xtics (" + ticks + ")");
  }
  canvas.line(plot);
}

void add_error_strips(PlotCanvas& canvas, const Report& report, const Box& box) {
  constexpr double kGapPx = 22.0;
  const LengthUnit unit = error_unit(report);
  const std::array<std::string, 4> names{std::string("x (") + unit.name + ")", std::string("y (") + unit.name + ")",
                                         std::string("z (") + unit.name + ")", "yaw (deg)"};
  const double height = (box.height() - kGapPx * 3.0) / 4.0;
  for (std::size_t strip = 0; strip < names.size(); ++strip) {
    const double top = box.top + static_cast<double>(strip) * (height + kGapPx);
    const bool last = strip + 1 == names.size();
    canvas.panel({box.left, top, box.right, top + height}, strip == 0 ? "Error over time" : "", last ? "time (s)" : "",
                 names[strip]);
    Range range;
    std::string plot = std::string("plot 0 with lines lw 1 lc rgb '") + kSoft + "'";
    for (std::size_t i = 0; i < report.evaluations.size(); ++i) {
      for (const PoseError& error : report.evaluations[i].errors) {
        range.add(strip < 3 ? unit.per_m * error.translation_m[static_cast<int>(strip)] : error.yaw_rad * kDegrees);
      }
      plot += ", " + block("errors", i) +
              " using 1:" + scaled(6 + static_cast<int>(strip), strip < 3 ? unit.per_m : 1.0) + " with lines " +
              curve(i);
    }
    const double size = std::max(range.size(), 1e-6);
    canvas.line("set yrange [" + number(range.low - 0.08 * size) + ":" + number(range.high + 0.08 * size) +
                "]; set ytics " + number(round_number_below(size / 2.0)) + "; set xrange [0:*] noextend");
    if (!last) canvas.line("set format x ''");
    canvas.line(plot);
  }
}

void add_times(PlotCanvas& canvas, StageTimes times, const Box& box) {
  std::stable_sort(times.begin(), times.end(),
                   [](const StageTime& a, const StageTime& b) { return a.wall.median_ms > b.wall.median_ms; });
  const std::size_t told = times.size();
  if (told > kMaxStages) times.resize(kMaxStages);
  const bool all = told == times.size();
  canvas.panel(box,
               std::string(all ? "Time of each stage" : "Time of the slowest stages") + ": median (dark), 95 % (light)",
               "wall time (ms)", "", box.left - 330.0);
  double longest = 1e-3;
  std::string names;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double y = -static_cast<double>(i);
    const double light = times[i].wall.p95_ms;
    const double dark = times[i].wall.median_ms;
    longest = std::max({longest, light, dark});
    canvas.line("set object " + std::to_string(2 * i + 1) + rectangle(y - 0.34, y + 0.34, light, "#A9D0E8"));
    canvas.line("set object " + std::to_string(2 * i + 2) + rectangle(y - 0.34, y + 0.34, dark, kColours[0]));
    canvas.line("set label " + std::to_string(200 + i) + " " +
                gnuplot_quoted(to_text(dark, 1) + " / " + to_text(light, 1)) + " at " + number(std::max(light, dark)) +
                "," + number(y) + " left offset 0.6,0 front font ',12'" + ink());
    names +=
        (i == 0 ? "" : ", ") + gnuplot_quoted(shortened(times[i].component + "/" + times[i].stage)) + " " + number(y);
  }
  canvas.line("set xrange [0:" + number(1.3 * longest) + "]; set yrange [" +
              number(-static_cast<double>(times.size()) + 0.3) + ":0.7]; set ytics (" + names + ") font ',11'");
  canvas.line("plot NaN");
}

}  // namespace panvo::evaluation
