// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace panvo::simulated_world {

/// A road's centre line, parameterised by arc length.
class RoadLine {
 public:
  explicit RoadLine(const std::vector<Eigen::Vector2d>& points);

  double length_m() const { return along_m_.back(); }
  Eigen::Vector2d point(double along_m) const;    ///< extended straight beyond the ends
  Eigen::Vector2d forward(double along_m) const;  ///< unit; interpolated between the points
  Eigen::Vector2d beside(double along_m, double left_m) const;

 private:
  std::size_t piece(double along_m) const;

  std::vector<Eigen::Vector2d> points_;
  std::vector<double> along_m_;
};

}  // namespace panvo::simulated_world
