// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "panvo/calibration/observations.hpp"
#include "panvo/vision/lens.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::calibration {

/// A camera of a rig, in its optical frame: X right, Y down, Z forward.
struct RigCamera {
  vision::LensCamera lens;
  Eigen::Isometry3d camera_from_reference = Eigen::Isometry3d::Identity();
};

/// Cameras and the board pose of each view in the frame of the reference camera.
struct Rig {
  std::vector<RigCamera> cameras;
  std::vector<std::optional<Eigen::Isometry3d>> reference_from_board;  ///< by view; nullopt: the view is not used
};

/// Standard deviations of the estimates, from the residuals and the Jacobian.
struct CameraSigmas {
  Eigen::VectorXd lens;                                  ///< of lens_parameters(); zero if fixed
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< of the reference's origin in the camera frame
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();
};

struct BundleOptions {
  std::size_t reference = 0;     ///< the camera whose pose is fixed
  bool are_lenses_held = false;  ///< estimate only poses
  double loss_px = 0.0;          ///< threshold of the Huber loss; 0: squared loss
};

/// Bundle adjustment: optimises lenses, camera poses and board poses to minimise the squared reprojection errors.
/// Returns false if the solver fails.
bool adjust(const Observations& observations, const BundleOptions& options, Rig& rig);

/// Standard deviations of `rig` after adjust(), by camera; nullopt if the corners do not determine all parameters.
std::optional<std::vector<CameraSigmas>> uncertainty(const Observations& observations, const BundleOptions& options,
                                                     const Rig& rig);

/// Reprojection error of a corner: observed minus predicted position.
struct Residual {
  std::size_t camera = 0;
  std::size_t view = 0;
  std::size_t corner = 0;  ///< index into View::seen[camera]
  Eigen::Vector2d pixel;
  Eigen::Vector2d error_px;  ///< (1000, 1000) if the corner does not project into the image
};

std::vector<Residual> residuals(const Observations& observations, const Rig& rig);

/// Root mean square of the error norms, px; 0 if there are no residuals.
double rms_px(const std::vector<Residual>& residuals);

}  // namespace panvo::calibration
