// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "plot_axes.hpp"

namespace panvo::evaluation {

/// A chart as inline SVG, drawn in pixels and scaled by the browser. Styles are CSS classes of the page.
class SvgChart {
 public:
  /// `plot`: data area within the `width_px` x `height_px` image.
  SvgChart(double width_px, double height_px, Box plot, Range x, Range y, const std::string& description);

  double x(double value) const;
  double y(double value) const;

  void grid(const std::string& x_label, const std::string& y_label);
  /// Drops points that are indistinguishable at this size.
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

/// HTML legend of styles and their names.
std::string legend(const std::vector<std::pair<std::string, std::string>>& styles_and_names);

/// A range from 0 to slightly above `high`.
Range from_zero(double high);

}  // namespace panvo::evaluation
