// SPDX-License-Identifier: Apache-2.0
#include "plot_canvas.hpp"

#include <algorithm>

#include "gnuplot.hpp"

namespace panvo::evaluation {

PlotCanvas& PlotCanvas::line(const std::string& text) {
  text_.append(text).append("\n");
  return *this;
}

void PlotCanvas::row(std::initializer_list<double> values) {
  const char* separator = "";
  for (const double value : values) {
    text_.append(separator).append(number(value));
    separator = " ";
  }
  text_.append("\n");
}

void PlotCanvas::panel(Box box, const std::string& title, const std::string& x_label, const std::string& y_label,
                       double title_left_px) {
  constexpr double kLabelPx = 86.0;
  box.top += body_top_px_;
  box.bottom += body_top_px_;
  line("unset label; unset arrow; unset object");
  line("set lmargin at screen " + number(box.left / kWidthPx) + "; set rmargin at screen " +
       number(box.right / kWidthPx) + "; set tmargin at screen " + number(1.0 - box.top / height_px_) +
       "; set bmargin at screen " + number(1.0 - box.bottom / height_px_));
  line("set autoscale; set xtics autofreq nomirror; set ytics autofreq nomirror font ',14'; set format '%g'");
  line("set xlabel " + gnuplot_quoted(x_label) + ink());
  // A label instead of a ylabel, whose position depends on the width of the tick labels.
  line("set label 99 " + gnuplot_quoted(y_label) + " " + at_screen(box.left - kLabelPx, 0.5 * (box.top + box.bottom)) +
       " center rotate by 90" + ink());
  if (title.empty()) return;
  line("set label 100 " + gnuplot_quoted(title) + " " +
       at_screen(title_left_px >= 0.0 ? title_left_px : box.left, box.top - 24.0) + " left" + bold(15) + ink());
}

void PlotCanvas::y_from_zero(double high) {
  const double top = std::max(1.06 * high, 1e-9);
  line("set yrange [0:" + number(top) + "]; set ytics " + number(round_number_below(top / 3.0)));
}

std::string PlotCanvas::at_screen(double x_px, double y_px) const {
  return "at screen " + number(x_px / kWidthPx) + ", screen " + number(1.0 - y_px / height_px_);
}

std::string ink() { return std::string(" textcolor rgb '") + kInk + "'"; }

std::string bold(int size) { return std::string(" font bold.',") + std::to_string(size) + "'"; }

std::string mark_size(double size) { return " ps marks*" + number(size); }

std::string colour(std::size_t estimate) { return "rgb colour" + std::to_string(estimate); }

std::string curve(std::size_t estimate, double width) {
  const std::size_t dashes = 1 + estimate / kColours.size();
  return "lw " + number(width) + " dt " + std::to_string(dashes) + " lc " + colour(estimate);
}

std::string block(const char* kind, std::size_t estimate) { return std::string("$") + kind + std::to_string(estimate); }

}  // namespace panvo::evaluation
