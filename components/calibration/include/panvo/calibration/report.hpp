// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "panvo/calibration/board.hpp"
#include "panvo/calibration/epipolar_error.hpp"
#include "panvo/calibration/rig_calibration.hpp"

namespace panvo::calibration {

/// What a calibration found and how far it may be believed, for people.
struct Report {
  std::string title;
  Board board;
  Observations seen;  ///< before anything was rejected, with the reasons of what was not seen
  RigCalibration calibration;
  std::size_t reference = 0;
  std::optional<vision::RectifiedStereo> pair;  ///< of a stereo calibration ...
  std::vector<EpipolarError> epipolar;          ///< ... and how well rows agree in it
};

/// What speaks against the result, a sentence each with what to do; empty: nothing. Judged by how many images there are, where in them the board
/// was, what is left over, and the standard deviations.
std::vector<std::string> doubts(const Report& report);

/// The same as plain text: images used and rejected with the reason, residuals, parameters with standard deviations, doubts.
std::string to_text(const Report& report);

/// A page by itself, with coverage and residuals drawn.
std::string to_page(const Report& report);

/// Where in the images of a camera corners were seen, coloured by how far they are off, as SVG.
std::string coverage_svg(const Report& report, std::size_t camera);

/// How far off corners are, and in which images, as SVG.
std::string residual_svg(const Report& report, std::size_t camera);

}  // namespace panvo::calibration
