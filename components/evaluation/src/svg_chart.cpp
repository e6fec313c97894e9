// SPDX-License-Identifier: Apache-2.0
#include "svg_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "html_text.hpp"

namespace panvo::evaluation {
namespace {

constexpr double kMinStep_px = 0.7;  // points nearer to the last one are dropped

std::string tip_of(const std::string& tip) { return tip.empty() ? "" : "<title>" + html(tip) + "</title>"; }

}  // namespace

SvgChart::SvgChart(double width_px, double height_px, Box plot, Range x, Range y, const std::string& description)
    : plot_(plot), x_(x), y_(y) {
  text_ = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", number(width_px),
                      number(height_px), html(description));
}

double SvgChart::x(double value) const { return plot_.left + (value - x_.low) / x_.size() * plot_.width(); }

double SvgChart::y(double value) const { return plot_.bottom - (value - y_.low) / y_.size() * plot_.height(); }

void SvgChart::grid(const std::string& x_label, const std::string& y_label) {
  const double x_step = round_number_below(x_.size() / 5.0);
  for (double at = std::ceil(x_.low / x_step) * x_step; at <= x_.high + 1e-9 * x_step; at += x_step) {
    text_ += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", x(at),
                         plot_.bottom + 18.0, fmt::format("{:g}", std::abs(at) < 1e-9 * x_step ? 0.0 : at));
  }
  const double y_step = round_number_below(y_.size() / 3.0);
  for (double at = std::ceil(y_.low / y_step) * y_step; at <= y_.high + 1e-9 * y_step; at += y_step) {
    text_ += fmt::format(
        "<path class=\"grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/><text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" "
        "text-anchor=\"end\">{}</text>\n",
        plot_.left, y(at), plot_.right, plot_.left - 8.0, y(at) + 4.0,
        fmt::format("{:g}", std::abs(at) < 1e-9 * y_step ? 0.0 : at));
  }
  text_ += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", plot_.right,
                       plot_.bottom + 36.0, html(x_label));
  text_ += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", plot_.left - 34.0,
                       plot_.top - 10.0, html(y_label));
}

void SvgChart::curve(const std::vector<Eigen::Vector2d>& points, const std::string& style) {
  if (points.empty()) return;
  std::string path;
  Eigen::Vector2d last(-1e9, -1e9);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d at(x(points[i].x()), y(points[i].y()));
    if ((at - last).norm() < kMinStep_px && i + 1 < points.size()) continue;
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : " ", at.x(), at.y());
    last = at;
  }
  text_ += fmt::format("<path class=\"curve {}\" d=\"{}\"/>\n", style, path);
}

void SvgChart::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const std::string& style,
                    const std::string& tip) {
  text_ += fmt::format("<path class=\"{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\">{}</path>\n", style, x(from.x()),
                       y(from.y()), x(to.x()), y(to.y()), tip_of(tip));
}

void SvgChart::dot(const Eigen::Vector2d& at, double radius_px, const std::string& style, const std::string& tip) {
  text_ += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\">{}</circle>\n", style, x(at.x()),
                       y(at.y()), number(radius_px), tip_of(tip));
}

void SvgChart::band(double from_x, double to_x, const std::string& style, const std::string& tip) {
  text_ += fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\">{}</rect>\n",
                       style, x(from_x), plot_.top, std::max(0.5, x(to_x) - x(from_x)), plot_.height(), tip_of(tip));
}

void SvgChart::label(const Eigen::Vector2d& at, double dx_px, double dy_px, const std::string& anchor,
                     const std::string& text, const std::string& style) {
  text_ += fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", style,
                       x(at.x()) + dx_px, y(at.y()) + dy_px, anchor, html(text));
}

std::string legend(const std::vector<std::pair<std::string, std::string>>& styles_and_names) {
  std::string text = "<p class=\"legend\">";
  for (const auto& [style, name] : styles_and_names) {
    text += fmt::format("<span><i class=\"{}\"></i>{}</span>", style, html(name));
  }
  return text + "</p>\n";
}

Range from_zero(double high) { return {0.0, std::max(1.06 * high, 1e-6)}; }

}  // namespace panvo::evaluation
