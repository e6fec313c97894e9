// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "panvo/calibration/observations.hpp"
#include "panvo/vision/camera.hpp"
#include "panvo/vision/lens.hpp"

namespace panvo::calibration {

/// By how much a corner's row in the rectified right image is below that in the left one.
struct EpipolarError {
  std::size_t view = 0;
  Eigen::Vector2d left_pixel;  ///< rectified
  double row_error_px = 0.0;
};

/// Of every corner that cameras 0 (left) and 1 (right) of `observations` both saw, and that both rectified images show.
std::vector<EpipolarError> epipolar_errors(const Observations& observations, const vision::LensCamera& left,
                                           const vision::LensCamera& right, const vision::RectifiedStereo& pair);

struct EpipolarSummary {
  std::size_t corners = 0;
  double mean_px = 0.0;
  double rms_px = 0.0;
  double largest_px = 0.0;
};

EpipolarSummary summarise(const std::vector<EpipolarError>& errors);

}  // namespace panvo::calibration
