// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "panvo/evaluation/evaluation.hpp"
#include "panvo/evaluation/trajectory.hpp"

namespace panvo::evaluation {

// All estimates against one ground truth.
struct Report {
  std::string title;
  Trajectory ground_truth;
  std::vector<Evaluation> evaluations;  // at least one
};

// Text table: one row per metric with its unit, one column per estimate, "-" for undefined values.
std::string to_table(const Report& report);

// evaluation.json: every figure, null for undefined values, units in the names.
std::string to_json(const Report& report);

// errors.csv: one line per pose of each estimate.
std::string to_csv(const Report& report);

}  // namespace panvo::evaluation
