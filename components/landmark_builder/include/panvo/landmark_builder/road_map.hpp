// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "panvo/landmark_builder/ground_projection.hpp"

namespace panvo::landmark_builder {

/// The vehicle's pose in the horizontal plane of the odometry frame.
struct PlanarPose {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  double yaw_rad = 0.0;                                ///< left positive

  static PlanarPose of(const Eigen::Isometry3d& odom_from_base);
  Eigen::Vector2d to_odom(const Eigen::Vector2d& point_in_base) const;
  Eigen::Vector2d to_base(const Eigen::Vector2d& point_in_odom) const;
};

struct RoadMapParameters {
  double radius_m = 27.0;
  double full_weight_range_m = 7.0;
  double body_ahead_m = 3.0;
  double body_behind_m = 2.5;
  double body_side_m = 1.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = RoadMapParameters;
    field(&P::radius_m, "radius_m", "m", "half the side of the road map around the vehicle", 10.0, 100.0);
    field(&P::full_weight_range_m, "full_weight_range_m", "m",
          "range of full resolution; views of more distant ground have less weight", 1.0, 50.0);
    field(&P::body_ahead_m, "body_ahead_m", "m", "extent of the footprint, always road, ahead of the base", 0.1, 20.0);
    field(&P::body_behind_m, "body_behind_m", "m", "the same, behind the base", 0.1, 20.0);
    field(&P::body_side_m, "body_side_m", "m", "the same, to either side", 0.1, 5.0);
  }
};

/// The road around the vehicle, accumulated over bird's-eye views placed by odometry: regions that one panorama shows
/// coarsely or that are occluded by the vehicle or other cars are filled in by others. Beyond the paper, which
/// evaluates each panorama individually.
///
/// The map does not rotate; it follows the vehicle by whole cells. Rows point along -x of the odometry frame, columns
/// along -y.
class RoadMap {
 public:
  RoadMap(const RoadMapParameters& parameters, double resolution_m);

  /// Adds a view: log ratios of road (32FC1) and their weights (32FC1, 0 where the vehicle covers the ground), both on
  /// `grid`.
  void add(const cv::Mat& ratio, const cv::Mat& weight, const GroundGrid& grid, const PlanarPose& odom_from_base);
  /// Marks the ground under the vehicle as road.
  void add_footprint(const PlanarPose& odom_from_base);
  /// Resets all cells to unknown.
  void clear();

  /// Sums of log ratios, clamped (32FC1): positive road, negative not road, 0 unknown.
  const cv::Mat& evidence() const noexcept { return evidence_; }
  /// (column, row) of the map for a position in the odometry frame, and back.
  Eigen::Vector2d cell(const Eigen::Vector2d& point_in_odom) const;
  Eigen::Vector2d point(const Eigen::Vector2d& cell) const;
  double resolution_m() const noexcept { return resolution_m_; }
  int side() const noexcept { return evidence_.rows; }

 private:
  void follow(const Eigen::Vector2d& position);

  RoadMapParameters parameters_;
  double resolution_m_;
  cv::Mat evidence_;
  std::optional<Eigen::Vector2i> middle_;  // (x, y) of the middle cell, in cells from the odometry origin
};

}  // namespace panvo::landmark_builder
