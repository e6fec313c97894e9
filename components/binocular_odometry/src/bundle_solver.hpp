// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "panvo/vision/camera.hpp"
#include "panvo/vision/pose.hpp"

/// Binocular bundle adjustment of poses and points; each observation is a pixel in the left image and a disparity.
/// A dedicated Levenberg-Marquardt solver for a known problem structure (tens of poses, hundreds of points with three
/// parameters): points are eliminated block by block, without repeated allocations or look-ups.
namespace panvo::binocular_odometry {

/// A point as (x/z, y/z, 1/z) in an anchor frame, which is well conditioned at any distance. The anchor is constant,
/// not a state.
struct BundlePoint {
  Eigen::Isometry3d world_from_anchor = Eigen::Isometry3d::Identity();
  Eigen::Vector3d inverse_depth = Eigen::Vector3d::Zero();
};

struct BundleObservation {
  int frame = 0;
  int point = 0;
  Eigen::Vector3d pixel;          ///< u, v, disparity (px)
  Eigen::Vector3d inverse_sigma;  ///< 1 / px per component; 0 for a missing measurement
};

struct BundleProblem {
  std::vector<Eigen::Isometry3d> left_from_world;  ///< the first `fixed_frames` are constant
  int fixed_frames = 1;
  std::vector<BundlePoint> points;
  std::vector<BundleObservation> observations;  ///< ordered by point

  /// Common error of all measured disparities, mostly from a residual rotation between the cameras. Estimated together
  /// with poses and points; near and far points separate it from the motion.
  double disparity_offset_px = 0.0;
  double expected_offset_px = 0.0;
  double offset_information = 1e12;  ///< 1 / px^2, of expected_offset_px; the default fixes the offset
};

struct BundleOptions {
  int max_iterations = 8;
  double loss_scale = 2.0;        ///< of the Cauchy loss, in standard deviations
  double min_improvement = 1e-4;  ///< relative decrease of the cost below which iteration stops
};

struct BundleSummary {
  double initial_cost = 0.0;
  double final_cost = 0.0;
  int iterations = 0;
  double variance = 0.0;  ///< robust mean square of the whitened residuals per degree of freedom; 1 for correct sigmas
  Eigen::MatrixXd
      covariance;  ///< 6 n x 6 n, of the n free poses, as exp(error) * left_from_world; not scaled by `variance`
};

/// Whitened residual of an observation; infinite for a point that is not in front of the camera.
Eigen::Vector3d whitened_residual(const vision::RectifiedStereo& stereo, const Eigen::Isometry3d& left_from_world,
                                  const BundlePoint& point, const BundleObservation& observation,
                                  double disparity_offset_px = 0.0);

/// Adjusts poses, points and disparity offset in place.
BundleSummary solve(const vision::RectifiedStereo& stereo, BundleProblem& problem, const BundleOptions& options);

}  // namespace panvo::binocular_odometry
