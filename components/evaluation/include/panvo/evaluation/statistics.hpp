// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace panvo::evaluation {

// In the unit of the summarised values.
struct Summary {
  std::size_t count = 0;
  double mean = 0.0;
  double rmse = 0.0;
  double median = 0.0;
  double max = 0.0;
};

// nullopt for an empty vector.
std::optional<Summary> summarize(std::vector<double> values);

// x with P(chi-square of `degrees_of_freedom` <= x) = probability, for probability in (0, 1).
double chi_square_quantile(double degrees_of_freedom, double probability);

}  // namespace panvo::evaluation
