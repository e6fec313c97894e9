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

// A text table for people: a row a metric with its unit, a column an estimate, "-" for what could not be computed.
std::string to_table(const Report& report);

// evaluation.json: every figure, null for what could not be computed. Names carry their units.
std::string to_json(const Report& report);

// errors.csv: one line a pose of each estimate.
std::string to_csv(const Report& report);

}  // namespace panvo::evaluation
