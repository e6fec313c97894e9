// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "panvo/calibration/board.hpp"
#include "panvo/calibration/epipolar_error.hpp"
#include "panvo/calibration/rig_calibration.hpp"

namespace panvo::calibration {

/// Results and quality of a calibration for the report.
struct Report {
  std::string title;
  Board board;
  Observations seen;  ///< before rejection, with the reasons why the board was not seen
  RigCalibration calibration;
  std::size_t reference = 0;
  std::optional<vision::RectifiedStereo> pair;  ///< of a stereo calibration
  std::vector<EpipolarError> epipolar;          ///< row errors in `pair`
};

/// Warnings about the result, each a sentence with a remedy. Based on the number of images, the coverage, the residuals
/// and the standard deviations.
std::vector<std::string> doubts(const Report& report);

/// The report as plain text: used images, rejected ones with the reason, residuals, parameters with standard
/// deviations, doubts.
std::string to_text(const Report& report);

/// The report as a self-contained HTML page with plots of coverage and residuals.
std::string to_page(const Report& report);

/// SVG plot of a camera's corners over its image, coloured by reprojection error.
std::string coverage_svg(const Report& report, std::size_t camera);

/// SVG plot of a camera's reprojection errors: a scatter plot, and the rms of each image.
std::string residual_svg(const Report& report, std::size_t camera);

}  // namespace panvo::calibration
