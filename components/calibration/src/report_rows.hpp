// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "panvo/calibration/report.hpp"

namespace panvo::calibration {

using Rows = std::vector<std::vector<std::string>>;

/// Tables for the text report and the page; the first row is the header.
Rows camera_rows(const Report& report);  ///< a row for each camera: images, corners, coverage, rms
Rows parameter_rows(const Report& report, std::size_t camera);
Rows pose_rows(const Report& report);  ///< of each camera except the reference
/// Image, camera, reason. `with_unseen`: includes images in which the board was not found.
Rows rejection_rows(const Report& report, bool with_unseen);
std::string epipolar_sentence(const Report& report);

std::size_t used_views(const Observations& observations, std::size_t camera);
std::vector<Residual> residuals_of(const Report& report, std::size_t camera);

}  // namespace panvo::calibration
