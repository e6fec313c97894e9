// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string>

#include "plot_axes.hpp"

namespace panvo::evaluation {

constexpr double kWidthPx = 1800.0;
constexpr const char* kInk = "#222222";
constexpr const char* kSoft = "#666666";
constexpr const char* kTruthColour = "#B8B8B8";
constexpr const char* kGridColour = "#E6E6E6";
constexpr const char* kFont = "DejaVu Sans";
// Colours of Okabe and Ito, distinguishable with any colour vision.
constexpr std::array<const char*, 6> kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"};

// Collects a gnuplot script for one page, with coordinates in pixels from its top left corner.
class PlotCanvas {
 public:
  PlotCanvas(double body_top_px, double height_px) : body_top_px_(body_top_px), height_px_(height_px) {}

  const std::string& text() const { return text_; }
  PlotCanvas& line(const std::string& text);

  // `$name << E ... E` with `size` rows, each from a call of write(canvas, i); decimated evenly to about kMaxRows
  // rows, including the last.
  template <class Write>
  void data_block(const std::string& name, std::size_t size, const Write& write) {
    constexpr std::size_t kMaxRows = 3000;
    line(std::string("$").append(name).append(" << E"));
    const std::size_t stride = size / kMaxRows + 1;
    for (std::size_t i = 0; i < size; i += stride) write(*this, i);
    if (size > 0 && (size - 1) % stride != 0) write(*this, size - 1);
    line("E");
  }
  void row(std::initializer_list<double> values);

  // Starts a panel and resets the settings of the previous one. `box` is relative to the area below the heading.
  void panel(Box box, const std::string& title, const std::string& x_label, const std::string& y_label,
             double title_left_px = -1.0);
  // A y axis from 0 to slightly above `high`, with three to seven tick labels.
  void y_from_zero(double high);

  std::string at_screen(double x_px, double y_px) const;

 private:
  double body_top_px_;
  double height_px_;
  std::string text_;
};

// Parts of gnuplot commands.
std::string ink();                                            // colour of text
std::string bold(int size);                                   // font, from the gnuplot variable `bold`
std::string mark_size(double size);                           // of points, from the gnuplot variable `marks`
std::string colour(std::size_t estimate);                     // of an estimate, from a gnuplot variable
std::string curve(std::size_t estimate, double width = 2.0);  // line style of an estimate
std::string block(const char* kind, std::size_t estimate);    // name of a data block

}  // namespace panvo::evaluation
