// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "panvo/calibration/observations.hpp"
#include "panvo/vision/camera.hpp"
#include "panvo/vision/lens.hpp"

namespace panvo::calibration {

/// Row error of a corner in a rectified pair.
struct EpipolarError {
  std::size_t view = 0;
  Eigen::Vector2d left_pixel;  ///< rectified
  double row_error_px = 0.0;   ///< row in the right image minus row in the left image
};

/// Row errors of the corners that cameras 0 (left) and 1 (right) of `observations` both saw and that are inside both
/// rectified images.
std::vector<EpipolarError> epipolar_errors(const Observations& observations, const vision::LensCamera& left,
                                           const vision::LensCamera& right, const vision::RectifiedStereo& pair);

struct EpipolarSummary {
  std::size_t corners = 0;
  double mean_px = 0.0;
  double rms_px = 0.0;
  double max_px = 0.0;
};

EpipolarSummary summarise(const std::vector<EpipolarError>& errors);

}  // namespace panvo::calibration
