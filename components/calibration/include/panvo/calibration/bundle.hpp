// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "panvo/calibration/observations.hpp"
#include "panvo/vision/lens.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::calibration {

/// A camera of a rig. Frames are optical: X right, Y down, Z forward.
struct RigCamera {
  vision::LensCamera lens;
  Eigen::Isometry3d camera_from_reference = Eigen::Isometry3d::Identity();
};

/// Cameras, and where the board was in each view, in the frame of the reference camera.
struct Rig {
  std::vector<RigCamera> cameras;
  std::vector<std::optional<Eigen::Isometry3d>> reference_from_board;  ///< by view; nullopt: the view is left out
};

/// Standard deviations of what was found, from the residuals and how the corners determine it.
struct CameraSigmas {
  Eigen::VectorXd lens;                                  ///< of lens_parameters(); zero where it was held
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< of the reference's origin in the camera's frame
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();
};

struct BundleOptions {
  std::size_t reference = 0;     ///< the camera that is held
  bool are_lenses_held = false;  ///< only poses are found
  double loss_px = 0.0;          ///< residuals beyond count less (Huber); 0: each counts by its square
};

/// Moves lenses, cameras and boards until the corners are where the images have them: least squares of the distances in the images. False: it
/// did not converge.
bool adjust(const Observations& observations, const BundleOptions& options, Rig& rig);

/// How certain `rig` is after adjust(), each camera; nullopt: the corners do not determine it.
std::optional<std::vector<CameraSigmas>> uncertainty(const Observations& observations, const BundleOptions& options,
                                                     const Rig& rig);

/// Where a corner is in an image, less where the rig has it.
struct Residual {
  std::size_t camera = 0;
  std::size_t view = 0;
  std::size_t corner = 0;  ///< index into View::seen[camera]
  Eigen::Vector2d pixel;
  Eigen::Vector2d error_px;  ///< a thousand where the lens would not show the corner
};

std::vector<Residual> residuals(const Observations& observations, const Rig& rig);

/// Root of the mean square of the distances, px; 0 of none.
double rms_px(const std::vector<Residual>& residuals);

}  // namespace panvo::calibration
