// SPDX-License-Identifier: Apache-2.0
#include "plot_axes.hpp"

#include <algorithm>
#include <cmath>

#include "format.hpp"

namespace panvo::evaluation {

void Range::add(double value) {
  low = std::min(low, value);
  high = std::max(high, value);
}

double round_number_below(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  const double leading = value / power;
  return power * (leading >= 5.0 ? 5.0 : leading >= 2.0 ? 2.0 : 1.0);
}

PlanRanges equal_scale(const Range& x, const Range& y, const Box& box, double margin) {
  constexpr double kMinM = 0.1;  // minimum size of the axes, for a path that does not move
  const double free = 1.0 - 2.0 * margin;
  const double m_per_px =
      std::max({x.size() / (free * box.width()), y.size() / (free * box.height()), kMinM / box.width()});
  const double half_width = 0.5 * m_per_px * box.width();
  const double half_height = 0.5 * m_per_px * box.height();
  return {{x.centre() - half_width, x.centre() + half_width}, {y.centre() - half_height, y.centre() + half_height}};
}

std::string number(double value) { return to_text(value, 9, std::chars_format::general); }

}  // namespace panvo::evaluation
