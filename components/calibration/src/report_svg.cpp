// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "panvo/calibration/coverage.hpp"
#include "panvo/calibration/report.hpp"
#include "report_rows.hpp"

namespace panvo::calibration {
namespace {

constexpr double kPlotWidth_px = 520.0;
constexpr double kMargin_px = 44.0;
constexpr double kSide_px = 240.0;  // of the scatter plot

std::string open(double width, double height, const std::string& what) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "role=\"img\" "
      "aria-label=\"{2}\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "fill=\"#fff\"/>\n",
      width, height, what);
}

std::string label(double x, double y, const std::string& anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"#444\">{}</text>\n", x, y, anchor,
                     text);
}

/// Okabe-Ito colours: blue for small, yellow for medium, orange for large errors.
std::string colour(double off_px, double usual_px) {
  if (off_px < 1.5 * usual_px) return "#0072b2";
  return off_px < 3.0 * usual_px ? "#e69f00" : "#d55e00";
}

/// Step of the axis ticks for `range`: 1, 2 or 5 times a power of ten.
double step_of(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power * 2.5 >= range) return factor * power;
  }
  return 10.0 * power;
}

}  // namespace

std::string coverage_svg(const Report& report, std::size_t camera) {
  const auto& used = report.calibration.used;
  const auto& size = used.image_sizes[camera];
  const double scale = kPlotWidth_px / size.width;
  const double height = scale * size.height;
  const auto cells = coverage(used, camera);
  const int most = std::max(1, *std::max_element(cells.corners.begin(), cells.corners.end()));
  const auto off = residuals_of(report, camera);
  const double usual_px = rms_px(off);
  std::string svg = open(kPlotWidth_px + 2 * kMargin_px, height + 2 * kMargin_px,
                         fmt::format("corners in the image of {}", used.cameras[camera]));
  svg += label(kMargin_px, kMargin_px - 14, "start",
               fmt::format("{}: {} corners, {:.0f} % of the image covered", used.cameras[camera], off.size(),
                           100.0 * cells.share));
  for (int row = 0; row < Coverage::kRows; ++row) {
    for (int column = 0; column < Coverage::kColumns; ++column) {
      const int count = cells.corners.at(static_cast<std::size_t>(row * Coverage::kColumns + column));
      const double width = kPlotWidth_px / Coverage::kColumns;
      const double cell_height = height / Coverage::kRows;
      svg += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" fill-opacity=\"{:.2f}\" "
          "stroke=\"#ddd\"><title>{} corners</title></rect>\n",
          kMargin_px + width * column, kMargin_px + cell_height * row, width, cell_height,
          count == 0 ? "#d55e00" : "#0072b2", count == 0 ? 0.14 : 0.04 + 0.2 * count / most, count);
    }
  }
  for (const auto& residual : off)
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.6\" fill=\"{}\" fill-opacity=\"0.75\"/>\n",
                       kMargin_px + scale * residual.pixel.x(), kMargin_px + scale * residual.pixel.y(),
                       colour(residual.error_px.norm(), usual_px));
  svg += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#444\"/>\n",
      kMargin_px, kMargin_px, kPlotWidth_px, height);
  svg += label(kMargin_px, kMargin_px + height + 16, "start", "0");
  svg += label(kMargin_px + kPlotWidth_px, kMargin_px + height + 16, "end", fmt::format("{} px", size.width));
  svg += label(
      kMargin_px + 0.5 * kPlotWidth_px, kMargin_px + height + 32, "middle",
      fmt::format("blue: error up to 1.5 x rms ({:.2f} px), yellow: up to 3 x, orange: above; orange cells: no corners",
                  usual_px));
  return svg + "</svg>\n";
}

std::string residual_svg(const Report& report, std::size_t camera) {
  const auto& used = report.calibration.used;
  const auto off = residuals_of(report, camera);
  double range = 1e-3;
  for (const auto& residual : off)
    range = std::max({range, std::abs(residual.error_px.x()), std::abs(residual.error_px.y())});
  const double step = step_of(range);
  range = step * std::ceil(range / step - 1e-9);
  const double bars_left = 2 * kMargin_px + kSide_px + 36.0;
  const double bars_width = kPlotWidth_px - 40.0;
  const double width = bars_left + bars_width + kMargin_px;
  const double height = kSide_px + 2 * kMargin_px;
  const double bottom = kMargin_px + kSide_px;
  std::string svg = open(width, height, fmt::format("residuals of {}", used.cameras[camera]));
  svg += label(kMargin_px, kMargin_px - 14, "start",
               fmt::format("{}: residuals, rms {:.3f} px", used.cameras[camera], rms_px(off)));

  const auto place = [&](double value) { return 0.5 * kSide_px * (1.0 + value / range); };
  for (double at = -range; at <= range + 1e-9; at += step) {
    const std::string text = fmt::format("{:g}", std::abs(at) < 1e-9 ? 0.0 : at);
    svg += fmt::format("<path d=\"M{0:.1f} {1:.1f}h{2:.0f}M{3:.1f} {4:.1f}v{2:.0f}\" stroke=\"#e4e4e4\"/>\n",
                       kMargin_px, kMargin_px + place(at), kSide_px, kMargin_px + place(at), kMargin_px);
    svg += label(kMargin_px + place(at), bottom + 16, "middle", text);
    svg += label(kMargin_px - 6, kMargin_px + place(at) + 4, "end", text);
  }
  svg += label(kMargin_px + 0.5 * kSide_px, bottom + 32, "middle", "x, y (px)");
  for (const auto& residual : off)
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.5\" fill=\"#0072b2\" fill-opacity=\"0.5\"/>\n",
                       kMargin_px + place(residual.error_px.x()), kMargin_px + place(residual.error_px.y()));

  std::vector<std::vector<Residual>> by_view(used.views.size());
  for (const auto& residual : off) by_view[residual.view].push_back(residual);
  double highest = 1e-3;
  for (const auto& view : by_view) highest = std::max(highest, rms_px(view));
  const double bar_step = step_of(highest);
  highest = bar_step * std::ceil(highest / bar_step - 1e-9);
  svg += label(bars_left, kMargin_px - 14, "start", "rms of each image (px)");
  for (double at = 0.0; at <= highest + 1e-9; at += bar_step) {
    const double y = bottom - kSide_px * at / highest;
    svg += fmt::format("<path d=\"M{:.1f} {:.1f}h{:.1f}\" stroke=\"#e4e4e4\"/>\n", bars_left, y, bars_width) +
           label(bars_left - 6, y + 4, "end", fmt::format("{:g}", at));
  }
  const double bar = bars_width / static_cast<double>(std::max<std::size_t>(1, by_view.size()));
  for (std::size_t view = 0; view < by_view.size(); ++view) {
    const double rms = rms_px(by_view[view]);
    svg += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#0072b2\"><title>{}: {:.3f} px, {} "
        "corners</title></rect>\n",
        bars_left + bar * (static_cast<double>(view) + 0.1), bottom - kSide_px * rms / highest, 0.8 * bar,
        kSide_px * rms / highest, used.views[view].name, rms, by_view[view].size());
  }
  svg += label(bars_left, bottom + 16, "start", used.views.empty() ? "" : used.views.front().name);
  svg += label(bars_left + bars_width, bottom + 16, "end", used.views.empty() ? "" : used.views.back().name);
  return svg + "</svg>\n";
}

}  // namespace panvo::calibration
