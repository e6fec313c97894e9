// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/statistics.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/SpecialFunctions>

namespace panvo::evaluation {

std::optional<Summary> summarize(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  Summary summary;
  summary.count = values.size();
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (const double value : values) {
    sum += value;
    sum_of_squares += value * value;
  }
  const auto count = static_cast<double>(values.size());
  summary.mean = sum / count;
  summary.rmse = std::sqrt(sum_of_squares / count);
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  summary.median = values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
  summary.max = values.back();
  return summary;
}

double chi_square_quantile(double degrees_of_freedom, double probability) {
  // The distribution function is the regularised lower incomplete gamma function; bisection inverts it.
  const auto distribution = [&](double x) { return Eigen::numext::igamma(0.5 * degrees_of_freedom, 0.5 * x); };
  double low = 0.0;
  double high = degrees_of_freedom + 10.0;
  while (distribution(high) < probability) high *= 2.0;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (distribution(middle) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace panvo::evaluation
