// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "panvo/evaluation/report.hpp"
#include "plot_canvas.hpp"

namespace panvo::evaluation {

// The data blocks of the panels: $truth, and for each estimate k $errors<k> and $segments<k>.
void add_data(PlotCanvas& canvas, const Report& report);

// Trajectories over the ground truth, with equal scale on both axes.
void add_plan(PlotCanvas& canvas, const Report& report, const Box& box);

void add_error_over_distance(PlotCanvas& canvas, const Report& report, const Box& box);

// A value of the segments to draw: its member, its column in $segments<k>, and the factor to the unit shown.
struct SegmentValue {
  double SegmentError::*member;
  int column;
  double factor;
};
void add_segments(PlotCanvas& canvas, const Report& report, const Box& box, const std::string& title,
                  const std::string& y_label, const SegmentValue& value);

// x, y, z and yaw, one below the other.
void add_error_strips(PlotCanvas& canvas, const Report& report, const Box& box);

// One bar per stage, the slowest first, with names in the 330 pixels to the left.
void add_times(PlotCanvas& canvas, StageTimes times, const Box& box);

}  // namespace panvo::evaluation
