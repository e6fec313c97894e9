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
Rows pose_rows(const Report& report);       ///< of each camera but the reference
Rows rejection_rows(const Report& report);  ///< image, camera, reason; of what was not seen, too
std::string epipolar_sentence(const Report& report);

std::size_t used_views(const Observations& observations, std::size_t camera);
std::vector<Residual> residuals_of(const Report& report, std::size_t camera);

}  // namespace panvo::calibration
