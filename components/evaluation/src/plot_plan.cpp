// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "format.hpp"
#include "gnuplot.hpp"
#include "plot_panels.hpp"
#include "plot_path.hpp"

namespace panvo::evaluation {
namespace {

using Path = std::vector<Eigen::Vector3d>;

// Direction in which the path leaves its first position, ignoring standstill and jitter.
template <class Iterator>
Eigen::Vector2d way_out(Iterator begin, Iterator end) {
  const Eigen::Vector2d from = begin->template head<2>();
  double extent = 0.0;
  for (Iterator i = begin; i != end; ++i) extent = std::max(extent, (i->template head<2>() - from).norm());
  for (Iterator i = begin; i != end; ++i) {
    const Eigen::Vector2d way = i->template head<2>() - from;
    if (way.norm() > 0.05 * extent) return way;
  }
  return Eigen::Vector2d::UnitX();
}

// A mark with its name on the side opposite to the path.
void add_place(PlotCanvas& canvas, int tag, const char* name, const Eigen::Vector3d& place, const Eigen::Vector2d& way,
               int point_type) {
  const bool sideways = std::abs(way.x()) >= std::abs(way.y());
  const char* where = sideways ? (way.x() > 0.0 ? "right offset -1.4,0" : "left offset 1.4,0")
                               : (way.y() > 0.0 ? "center offset 0,-1.2" : "center offset 0,1.2");
  canvas.line("set label " + std::to_string(tag) + " " + gnuplot_quoted(name) + " at " + number(place.x()) + "," +
              number(place.y()) + " " + where + " front point pt " + std::to_string(point_type) + mark_size(1.6) +
              " lc rgb '" + kInk + "'" + ink());
}

// Draws the scale bar in the corner with the fewest points of the paths.
void add_scale_bar(PlotCanvas& canvas, const Path& points, const PlanRanges& ranges) {
  const double length = round_number_below(ranges.x.size() / 5.0);
  std::array<std::size_t, 4> inside{};  // lower right, lower left, upper right, upper left
  for (const Eigen::Vector3d& point : points) {
    const double across = (point.x() - ranges.x.low) / ranges.x.size();
    const double up = (point.y() - ranges.y.low) / ranges.y.size();
    const bool near_corner = (across < 0.35 || across > 0.65) && (up < 0.2 || up > 0.8);
    if (near_corner) ++inside[(across > 0.5 ? 0 : 1) + (up > 0.5 ? 2 : 0)];
  }
  const auto corner = static_cast<std::size_t>(std::min_element(inside.begin(), inside.end()) - inside.begin());
  const double x =
      corner % 2 == 0 ? ranges.x.high - 0.05 * ranges.x.size() - length : ranges.x.low + 0.05 * ranges.x.size();
  const double y = corner < 2 ? ranges.y.low + 0.05 * ranges.y.size() : ranges.y.high - 0.08 * ranges.y.size();
  canvas.line("set arrow 1 from " + number(x) + "," + number(y) + " to " + number(x + length) + "," + number(y) +
              " heads size graph 0.006,90 front lw 2.5 lc rgb '" + kInk + "'");
  canvas.line("set label 103 " + gnuplot_quoted(to_text(length, 6, std::chars_format::general) + " m") + " at " +
              number(x + 0.5 * length) + "," + number(y) + " center offset 0,0.8 front" + ink());
}

}  // namespace

void add_plan(PlotCanvas& canvas, const Report& report, const Box& box) {
  const Path truth = true_positions(report);
  Path all = truth;
  for (const Evaluation& e : report.evaluations) {
    for (const PoseError& error : e.errors) all.push_back(error.estimate_m);
  }
  Range x{all.front().x(), all.front().x()};
  Range y{all.front().y(), all.front().y()};
  for (const Eigen::Vector3d& point : all) {
    x.add(point.x());
    y.add(point.y());
  }
  const PlanRanges ranges = equal_scale(x, y, box, 0.09);
  canvas.panel(box, "Plan view", "x (m)", "y (m)");
  const double step = round_number_below(ranges.x.size() / 4.0);
  canvas.line("set xrange [" + number(ranges.x.low) + ":" + number(ranges.x.high) + "]; set yrange [" +
              number(ranges.y.low) + ":" + number(ranges.y.high) + "]; set xtics " + number(step) + "; set ytics " +
              number(step));
  add_scale_bar(canvas, all, ranges);
  std::string plot = "plot ";
  if (!truth.empty()) {
    // The names of a closed drive's ends would overlap.
    const bool is_closed = (truth.back() - truth.front()).head<2>().norm() < 0.1 * ranges.x.size();
    add_place(canvas, 101, is_closed ? "start, end" : "start", truth.front(), way_out(truth.begin(), truth.end()), 7);
    add_place(canvas, 102, is_closed ? "" : "end", truth.back(), way_out(truth.rbegin(), truth.rend()), 5);
    plot += std::string("$truth using 1:2 with lines lw 9 lc rgb '") + kTruthColour + "', ";
  }
  for (std::size_t i = 0; i < report.evaluations.size(); ++i) {
    plot += (i == 0 ? "" : ", ") + block("errors", i) + " using 3:4 with lines " + curve(i, 2.5);
  }
  canvas.line(plot);
}

}  // namespace panvo::evaluation
