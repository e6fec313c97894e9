// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "panvo/calibration/bundle.hpp"
#include "panvo/calibration/observations.hpp"

namespace panvo::calibration {

struct RigOptions {
  std::vector<vision::LensModel> models;                  ///< of each camera
  std::vector<std::optional<vision::LensCamera>> lenses;  ///< to begin with; nullopt: found from the corners alone
  bool are_lenses_held = false;                           ///< all are given, and only poses are looked for
  std::size_t reference = 0;                              ///< the camera in whose frame the others are told
};

/// What one camera saw in one view and is not used.
struct Rejection {
  std::size_t camera = 0;
  std::size_t view = 0;
  std::string reason;
};

struct RigCalibration {
  Rig rig;
  Observations used;                                ///< without what was rejected
  std::vector<Residual> residuals;                  ///< of `used`
  std::vector<Rejection> rejections;                ///< ordered by view, then camera
  std::vector<std::size_t> stray_corners;           ///< single corners left out, each camera
  std::optional<std::vector<CameraSigmas>> sigmas;  ///< nullopt: what was seen does not determine everything
};

/// Lenses and poses of cameras that saw a board, often two of them at once: each camera by itself, then the poses from one to the next along
/// the pairs that share most views, then all together; corners and views that do not fit are left out on the way.
/// Throws CalibrationError, naming the camera: too few views, a camera that shares none with the others, or no solution.
RigCalibration calibrate(const Observations& observations, const RigOptions& options);

}  // namespace panvo::calibration
