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
  kRational,     ///< perspective, rational radial polynomial: k1 k2 p1 p2 k3 k4 k5 k6
  kEquidistant,  ///< Kannala-Brandt fisheye: k1 k2 k3 k4
  kMei,          ///< omnidirectional (catadioptric): k1 k2 p1 p2 and mirror parameter xi [Mei2007]
};

/// Intrinsic calibration of a raw camera with any lens. CameraModel defines the projection.
struct LensCamera {
  PinholeCamera pinhole;  ///< for kMei: generalised focal lengths
  LensModel model = LensModel::kPlumbBob;
  std::array<double, 8> distortion{};  ///< in the order above, padded with zeros
  double xi = 0.0;                     ///< for kMei; 0: perspective camera, 1: parabolic mirror
};

/// Camera from the fields of a ROS CameraInfo. `distortion_model`: plumb_bob (also radtan, radial-tangential),
/// rational_polynomial, equidistant (also fisheye), or mei (Kalibr: omni-radtan; not defined by ROS) with the five
/// coefficients k1 k2 p1 p2 xi. Missing coefficients are zero, surplus ones must be zero. The model may be empty or
/// unknown if all coefficients are zero. Throws std::invalid_argument, with a text to follow the camera's name.
LensCamera lens_camera(std::string_view distortion_model, std::span<const double> coefficients,
                       const PinholeCamera& pinhole);

/// Whether the lens is perspective and without distortion.
bool is_straight(const LensCamera& camera);

/// `distortion_model` in CameraInfo: "plumb_bob", "rational_polynomial", "equidistant", "mei".
std::string_view ros_name(LensModel model);

/// Distortion coefficients in the order of CameraInfo; the inverse of lens_camera().
std::vector<double> ros_coefficients(const LensCamera& camera);

}  // namespace panvo::vision
