// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "panvo/vision/lens.hpp"

namespace panvo::calibration {

/// The calibrated parameters of a lens, in this order: fx fy cx cy (px), the coefficients of the model.
std::vector<std::string> lens_parameter_names(vision::LensModel model);
Eigen::VectorXd lens_parameters(const vision::LensCamera& lens);

/// The lens with other parameters.
vision::LensCamera with_parameters(vision::LensCamera lens, const Eigen::VectorXd& parameters);

}  // namespace panvo::calibration
