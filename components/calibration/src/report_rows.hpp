// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "panvo/calibration/report.hpp"

namespace panvo::calibration {

using Rows = std::vector<std::vector<std::string>>;

/// Tables of a report, the header first, for text and page alike.
Rows camera_rows(const Report& report);  ///< a line a camera: images, corners, coverage, rms
Rows parameter_rows(const Report& report, std::size_t camera);
Rows pose_rows(const Report& report);  ///< of each camera but the reference
/// Image, camera, reason; `with_unseen`: of those in which the board was not seen, too.
Rows rejection_rows(const Report& report, bool with_unseen);
std::string epipolar_sentence(const Report& report);

std::size_t used_views(const Observations& observations, std::size_t camera);
std::vector<Residual> residuals_of(const Report& report, std::size_t camera);

}  // namespace panvo::calibration
