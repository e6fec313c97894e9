// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/lens_parameters.hpp"

namespace panvo::calibration {

std::vector<std::string> lens_parameter_names(vision::LensModel model) {
  std::vector<std::string> names{"fx", "fy", "cx", "cy"};
  for (const auto& coefficient : vision::lens_coefficients(model)) names.emplace_back(coefficient.name);
  return names;
}

Eigen::VectorXd lens_parameters(const vision::LensCamera& lens) {
  const auto coefficients = vision::ros_coefficients(lens);
  Eigen::VectorXd parameters(4 + static_cast<Eigen::Index>(coefficients.size()));
  parameters.head<4>() << lens.pinhole.fx, lens.pinhole.fy, lens.pinhole.cx, lens.pinhole.cy;
  for (std::size_t i = 0; i < coefficients.size(); ++i) parameters[4 + static_cast<Eigen::Index>(i)] = coefficients[i];
  return parameters;
}

vision::LensCamera with_parameters(vision::LensCamera lens, const Eigen::VectorXd& parameters) {
  lens.pinhole.fx = parameters[0];
  lens.pinhole.fy = parameters[1];
  lens.pinhole.cx = parameters[2];
  lens.pinhole.cy = parameters[3];
  lens.distortion = {};
  for (Eigen::Index i = 4; i < parameters.size(); ++i)
    lens.distortion.at(static_cast<std::size_t>(i - 4)) = parameters[i];
  return lens;
}

}  // namespace panvo::calibration
