// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "panvo/landmark_builder/ground_projection.hpp"

namespace panvo::landmark_builder {

/// Where the vehicle stands on the plane of the odometry's frame.
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
    field(&P::radius_m, "radius_m", "m", "half the side of the map of the road that goes with the vehicle", 10.0,
          100.0);
    field(&P::full_weight_range_m, "full_weight_range_m", "m",
          "range up to which the ground is seen as sharply as it is mapped; beyond, one look counts for less", 1.0,
          50.0);
    field(&P::body_ahead_m, "body_ahead_m", "m", "ground under the vehicle, ahead of its base: road for certain", 0.1,
          20.0);
    field(&P::body_behind_m, "body_behind_m", "m", "the same, behind its base", 0.1, 20.0);
    field(&P::body_side_m, "body_side_m", "m", "the same, to either side", 0.1, 5.0);
  }
};

/// The road around the vehicle, gathered from one bird's-eye view after the other as the odometry places them: what one
/// panorama sees coarsely from afar, or not at all behind the vehicle's body or another car, others have seen. Beyond the
/// paper, which looks at each panorama by itself.
///
/// The map does not turn; it follows the vehicle by whole cells. Rows go along -x of the odometry's frame, columns along -y.
class RoadMap {
 public:
  RoadMap(const RoadMapParameters& parameters, double resolution_m);

  /// Adds what a view shows: log ratios of road (32FC1) and how far each pixel may be believed (32FC1, 0 where the vehicle
  /// covers the ground), both on `grid`.
  void add(const cv::Mat& ratio, const cv::Mat& weight, const GroundGrid& grid, const PlanarPose& odom_from_base);
  /// The ground under the vehicle is road.
  void add_footprint(const PlanarPose& odom_from_base);
  /// Forgets all of it.
  void clear();

  /// Sums of log ratios, limited (32FC1): above 0 road, below not, 0 unknown.
  const cv::Mat& evidence() const noexcept { return evidence_; }
  /// Of the map: (column, row) of a place in the odometry's frame, and back.
  Eigen::Vector2d cell(const Eigen::Vector2d& point_in_odom) const;
  Eigen::Vector2d point(const Eigen::Vector2d& cell) const;
  double resolution_m() const noexcept { return resolution_m_; }
  int side() const noexcept { return evidence_.rows; }

 private:
  void follow(const Eigen::Vector2d& position);

  RoadMapParameters parameters_;
  double resolution_m_;
  cv::Mat evidence_;
  std::optional<Eigen::Vector2i> middle_;  // the place of the middle cell, in cells from the odometry's origin: (x, y)
};

}  // namespace panvo::landmark_builder
