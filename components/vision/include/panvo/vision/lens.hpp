// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "panvo/vision/camera.hpp"

namespace panvo::vision {

enum class LensModel {
  kPlumbBob,     ///< perspective, radial-tangential: k1 k2 p1 p2 k3
  kRational,     ///< perspective, with a quotient of polynomials: k1 k2 p1 p2 k3 k4 k5 k6
  kEquidistant,  ///< fisheye of Kannala and Brandt: k1 k2 k3 k4
  kMei,          ///< omnidirectional, of lens and mirror: k1 k2 p1 p2, and the mirror's xi [Mei2007]
};

/// A raw camera as it was calibrated, whatever its lens. What the numbers mean is CameraModel's matter.
struct LensCamera {
  PinholeCamera pinhole;  ///< of kMei: generalised focal lengths
  LensModel model = LensModel::kPlumbBob;
  std::array<double, 8> distortion{};  ///< in the order above, the rest zero
  double xi = 0.0;                     ///< of kMei: 0 a perspective camera, 1 a parabolic mirror
};

/// The camera of a calibration as ROS's CameraInfo words it: `distortion_model` is plumb_bob (also radtan, radial-tangential),
/// rational_polynomial, equidistant (also fisheye), or mei (also omni-radtan, as Kalibr calls it), whose five coefficients are
/// k1 k2 p1 p2 xi: ROS has no name for it. Fewer coefficients are filled up with zeros, further ones must be zero. Without
/// coefficients the model may be left out, too. Throws std::invalid_argument in words that follow the camera's name.
LensCamera lens_camera(std::string_view distortion_model, std::span<const double> coefficients,
                       const PinholeCamera& pinhole);

/// Whether it bends nothing: a perspective lens without distortion.
bool is_straight(const LensCamera& camera);

/// The model's name in CameraInfo: "plumb_bob", "rational_polynomial", "equidistant", "mei".
std::string_view ros_name(LensModel model);

/// The coefficients as CameraInfo has them: the opposite of lens_camera.
std::vector<double> ros_coefficients(const LensCamera& camera);

}  // namespace panvo::vision
