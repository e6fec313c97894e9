// SPDX-License-Identifier: Apache-2.0
// Reports for the tests of table, files and plot.
#pragma once

#include "panvo/evaluation/report.hpp"
#include "trajectories.hpp"

namespace panvo::evaluation {

inline Report small_report(const std::string& title = "a walk", const std::string& name = "first") {
  const Trajectory truth = winding_path(120);
  Estimate first{name, transformed(truth, make_pose(1, 2, 3, 0.4), 1.01), std::nullopt, {}, StageTimes{}};
  const TimeSummary time{5.0, 4.0, 9.0, 11.0, 20.0};
  first.timing->push_back({"vo", "match", 120, time, time});
  Estimate second{"second", transformed(truth, make_pose(0, 0, 0, 0.01)), std::nullopt, {}, std::nullopt};
  second.unreliable = 3;
  Report report{title, truth, {}};
  report.evaluations = {evaluate(first, truth), evaluate(second, truth)};
  return report;
}

// Nothing moves, so only the absolute error is defined.
inline Report still_report() {
  const Trajectory truth = straight_line(20, 0.0);
  return {"still", truth, {evaluate({"e", truth, std::nullopt, {}, std::nullopt}, truth)}};
}

}  // namespace panvo::evaluation
