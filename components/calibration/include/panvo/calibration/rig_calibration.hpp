// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "panvo/calibration/bundle.hpp"
#include "panvo/calibration/observations.hpp"

namespace panvo::calibration {

struct RigOptions {
  std::vector<vision::LensModel> models;                  ///< by camera
  std::vector<std::optional<vision::LensCamera>> lenses;  ///< initial lenses; nullopt: estimated from the corners
  bool are_lenses_held = false;  ///< keep `lenses`, all of which are given; estimate only poses
  std::size_t reference = 0;     ///< the camera that defines the reference frame
};

/// A camera's corners of one view that are not used.
struct Rejection {
  std::size_t camera = 0;
  std::size_t view = 0;
  std::string reason;
};

struct RigCalibration {
  Rig rig;
  Observations used;                                ///< without the rejected corners
  std::vector<Residual> residuals;                  ///< of `used`
  std::vector<Rejection> rejections;                ///< ordered by view, then camera
  std::vector<std::size_t> stray_corners;           ///< number of single outlier corners, by camera
  std::optional<std::vector<CameraSigmas>> sigmas;  ///< nullopt: the corners do not determine all parameters
};

/// Calibrates lenses and poses of cameras from views of a board, some of which two cameras share. Calibrates each
/// camera alone, chains the poses along the pairs with most shared views, then adjusts all together. Outlier views and
/// corners are rejected. Throws CalibrationError that names the camera: too few views, no views shared with others, no
/// solution.
RigCalibration calibrate(const Observations& observations, const RigOptions& options);

}  // namespace panvo::calibration
