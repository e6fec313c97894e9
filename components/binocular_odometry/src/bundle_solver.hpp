// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "panvo/vision/camera.hpp"
#include "panvo/vision/pose.hpp"

/// Binocular bundle adjustment: poses and points together, each observation a pixel in the left image and a disparity.
/// A small Levenberg-Marquardt of our own: the problem's shape is known (tens of poses, hundreds of points of three
/// parameters), so the points are eliminated block by block and nothing is allocated or looked up a second time.
namespace panvo::binocular_odometry {

/// A point as (x/z, y/z, 1/z) in a fixed anchor frame: well conditioned however far it is. The anchor is no state, only
/// where the coordinates are written down.
struct BundlePoint {
  Eigen::Isometry3d world_from_anchor = Eigen::Isometry3d::Identity();
  Eigen::Vector3d inverse_depth = Eigen::Vector3d::Zero();
};

struct BundleObservation {
  int frame = 0;
  int point = 0;
  Eigen::Vector3d pixel;          ///< u, v, disparity (px)
  Eigen::Vector3d inverse_sigma;  ///< 1 / px, component by component; 0 where there is no measurement
};

struct BundleProblem {
  std::vector<Eigen::Isometry3d> left_from_world;  ///< the first `fixed_frames` stay as they are
  int fixed_frames = 1;
  std::vector<BundlePoint> points;
  std::vector<BundleObservation> observations;  ///< ordered by point

  /// What the calibration leaves over, mostly a small turn of one camera against the other: every measured disparity is this
  /// much too large. Estimated along with the rest; near and far points that move past tell it from the motion.
  double disparity_offset_px = 0.0;
  double expected_offset_px = 0.0;
  double offset_information = 1e12;  ///< 1 / px^2, of the expectation: this large keeps the offset as it is
};

struct BundleOptions {
  int max_iterations = 8;
  double loss_scale = 2.0;             ///< of Cauchy's loss, in standard deviations
  double smallest_improvement = 1e-4;  ///< relative decrease of the cost that is worth another iteration
};

struct BundleSummary {
  double initial_cost = 0.0;
  double final_cost = 0.0;
  int iterations = 0;
  double variance =
      0.0;  ///< robust mean square of the whitened residuals per degree of freedom: 1 when sigmas are right
  Eigen::MatrixXd
      covariance;  ///< 6 n x 6 n, of the n free poses, each as exp(error) * left_from_world; not scaled by variance
};

/// Whitened residual of an observation; squared norm infinite for a point that is not in front.
Eigen::Vector3d whitened_residual(const vision::RectifiedStereo& stereo, const Eigen::Isometry3d& left_from_world,
                                  const BundlePoint& point, const BundleObservation& observation,
                                  double disparity_offset_px = 0.0);

/// Improves poses and points in place.
BundleSummary solve(const vision::RectifiedStereo& stereo, BundleProblem& problem, const BundleOptions& options);

}  // namespace panvo::binocular_odometry
