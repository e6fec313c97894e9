// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "panvo/vision/camera.hpp"
#include "panvo/vision/lens_models.hpp"

namespace panvo::vision {

/// Intrinsic calibration of a raw camera with any lens. CameraModel projects with it.
struct LensCamera {
  PinholeCamera pinhole;
  LensModel model = LensModel::kPlumbBob;
  std::array<double, kMaxLensCoefficients> distortion{};  ///< the model's coefficients, padded with zeros
};

/// Camera from the fields of a ROS CameraInfo. `distortion_model`: a name known to find_lens_model(); ROS does not define
/// all of them. Missing coefficients are zero, surplus ones must be zero. The model may be empty or unknown if all
/// coefficients are zero. Throws std::invalid_argument, with a text to follow the camera's name.
LensCamera lens_camera(std::string_view distortion_model, std::span<const double> coefficients,
                       const PinholeCamera& pinhole);

/// Whether the lens is perspective and without distortion.
bool is_straight(const LensCamera& camera);

/// `distortion_model` in CameraInfo: "plumb_bob", "rational_polynomial", "equidistant", "mei", ...
std::string_view ros_name(LensModel model);

/// The model of a ROS name or one of its other names, such as Kalibr's; nullopt if there is none.
std::optional<LensModel> find_lens_model(std::string_view name);

/// Names, initial values and ranges of a model's coefficients, in the order of CameraInfo.
std::span<const LensCoefficient> lens_coefficients(LensModel model);

/// Distortion coefficients in the order of CameraInfo; the inverse of lens_camera().
std::vector<double> ros_coefficients(const LensCamera& camera);

}  // namespace panvo::vision
