// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace panvo::evaluation {

// A rectangle on the canvas in pixels, from the top left.
struct Box {
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;

  double width() const { return right - left; }
  double height() const { return bottom - top; }
};

struct Range {
  double low = 0.0;
  double high = 0.0;

  void add(double value);
  double size() const { return high - low; }
  double centre() const { return 0.5 * (low + high); }
};

// Largest 1, 2 or 5 times a power of ten that is at most `value`; `value` must be positive.
double round_number_below(double value);

// Enlarges both ranges to equal scale on both axes of `box`, with `margin` (a fraction) free on each side.
struct PlanRanges {
  Range x;
  Range y;
};
PlanRanges equal_scale(const Range& x, const Range& y, const Box& box, double margin);

// Short decimal number for a gnuplot script.
std::string number(double value);

}  // namespace panvo::evaluation
