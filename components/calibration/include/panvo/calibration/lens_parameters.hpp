// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "panvo/vision/lens.hpp"

namespace panvo::calibration {

/// The numbers of a lens that are calibrated, in their order: fx fy cx cy (px), then the distortion, then xi of kMei.
std::vector<std::string> lens_parameter_names(vision::LensModel model);
Eigen::VectorXd lens_parameters(const vision::LensCamera& lens);

/// The same lens with other numbers.
vision::LensCamera with_parameters(vision::LensCamera lens, const Eigen::VectorXd& parameters);

}  // namespace panvo::calibration
