// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/lens_parameters.hpp"

namespace panvo::calibration {

using vision::LensModel;

std::vector<std::string> lens_parameter_names(LensModel model) {
  std::vector<std::string> names{"fx", "fy", "cx", "cy"};
  const auto add = [&](std::initializer_list<const char*> more) {
    names.insert(names.end(), more.begin(), more.end());
  };
  switch (model) {
    case LensModel::kPlumbBob:
      add({"k1", "k2", "p1", "p2", "k3"});
      break;
    case LensModel::kRational:
      add({"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"});
      break;
    case LensModel::kEquidistant:
      add({"k1", "k2", "k3", "k4"});
      break;
    case LensModel::kMei:
      add({"k1", "k2", "p1", "p2", "xi"});
      break;
  }
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
  const Eigen::Index count = parameters.size() - (lens.model == LensModel::kMei ? 5 : 4);
  for (Eigen::Index i = 0; i < count; ++i) lens.distortion.at(static_cast<std::size_t>(i)) = parameters[4 + i];
  if (lens.model == LensModel::kMei) lens.xi = parameters[8];
  return lens;
}

}  // namespace panvo::calibration
