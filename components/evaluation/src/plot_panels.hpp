// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "panvo/evaluation/report.hpp"
#include "plot_canvas.hpp"

namespace panvo::evaluation {

// The data blocks that the panels draw: $truth, and for each estimate k $errors<k> and $segments<k>.
void add_data(PlotCanvas& canvas, const Report& report);

// Paths over the ground truth, a metre as long on either axis.
void add_plan(PlotCanvas& canvas, const Report& report, const Box& box);

void add_error_over_distance(PlotCanvas& canvas, const Report& report, const Box& box);

// What is drawn of the segments: a member, where it stands in $segments<k>, and the factor of the unit shown.
struct SegmentValue {
  double SegmentError::*member;
  int column;
  double factor;
};
void add_segments(PlotCanvas& canvas, const Report& report, const Box& box, const std::string& title,
                  const std::string& y_label, const SegmentValue& value);

// x, y, z and yaw, one below the other.
void add_error_strips(PlotCanvas& canvas, const Report& report, const Box& box);

// A bar a stage, the slowest first, and names 330 pixels to its left.
void add_times(PlotCanvas& canvas, StageTimes times, const Box& box);

}  // namespace panvo::evaluation
