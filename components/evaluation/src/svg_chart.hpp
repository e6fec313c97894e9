// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "plot_axes.hpp"

namespace panvo::evaluation {

/// A diagram as inline SVG, drawn in pixels and scaled by the browser. Colours are classes of the page's style.
class SvgChart {
 public:
  /// `plot`: where the data lie, in a picture of `width_px` x `height_px`.
  SvgChart(double width_px, double height_px, Box plot, Range x, Range y, const std::string& description);

  double x(double value) const;
  double y(double value) const;

  void grid(const std::string& x_label, const std::string& y_label);
  /// Thinned to what can be seen.
  void curve(const std::vector<Eigen::Vector2d>& points, const std::string& style);
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const std::string& style,
            const std::string& tip = "");
  void dot(const Eigen::Vector2d& at, double radius_px, const std::string& style, const std::string& tip);
  void band(double from_x, double to_x, const std::string& style, const std::string& tip = "");
  /// `anchor`: start, middle or end.
  void label(const Eigen::Vector2d& at, double dx_px, double dy_px, const std::string& anchor, const std::string& text,
             const std::string& style = "small");
  void raw(const std::string& markup) { text_ += markup; }
  std::string text() const { return text_ + "</svg>\n"; }

 private:
  Box plot_;
  Range x_, y_;
  std::string text_;
};

/// "<span class=key ..>": what a colour stands for.
std::string legend(const std::vector<std::pair<std::string, std::string>>& styles_and_names);

/// A range from 0 to a little above `high`.
Range from_zero(double high);

}  // namespace panvo::evaluation
