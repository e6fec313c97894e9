// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>

namespace panvo::vision {

/// Point of the normalised image (focal length 1, origin at the principal point). T: double, or a type that carries
/// derivatives.
template <class T>
using NormalisedPoint = Eigen::Matrix<T, 2, 1>;

struct LensCoefficient {
  std::string_view name;
  double start = 0.0;                                     ///< initial value of a calibration
  double min = -std::numeric_limits<double>::infinity();  ///< smallest valid value
  double max = std::numeric_limits<double>::infinity();   ///< largest valid value
  bool is_optional = true;                                ///< files may omit it at the end of the list; it is then zero
};

/// How Kalibr writes a lens model. Further coefficients have no place in its files and must be zero.
struct KalibrForm {
  std::string_view camera_model;
  std::string_view distortion_model;
  std::size_t distortion_count;  ///< the first coefficients, which are Kalibr's distortion_coeffs
  std::size_t intrinsic_count;   ///< the coefficients after them, which Kalibr writes in front of the focal lengths
};

/// What a lens model defines. Directions are in the optical frame (X right, Y down, Z forward). A direction at the
/// angle theta from the axis has a radius in the normalised image that depends on theta alone; the distortion then
/// moves that point. `c` points to the coefficients, in the order of kCoefficients. radius() and distortion() are
/// templates, since calibration differentiates them.
template <class Formula>
concept LensFormula = requires(const double* c, double number, NormalisedPoint<double> point) {
  // name in CameraInfo, further names in files, and a few words for the help of `panvo calibrate`
  { Formula::kName } -> std::convertible_to<std::string_view>;
  { *Formula::kAliases.data() } -> std::convertible_to<std::string_view>;
  { Formula::kPurpose } -> std::convertible_to<std::string_view>;
  { *Formula::kCoefficients.data() } -> std::convertible_to<LensCoefficient>;
  { Formula::kKalibr } -> std::convertible_to<std::optional<KalibrForm>>;  // nullopt: Kalibr lacks the model

  // whether the radius is tan(theta)
  { Formula::kIsPerspective } -> std::convertible_to<bool>;

  // whether other coefficients compensate the focal lengths, so that their standard deviation alone means little
  { Formula::kIsFocalCorrelated } -> std::convertible_to<bool>;

  // radius at theta, before distortion: zero on the axis, growing up to limit_rad(), negative outside the domain
  { Formula::radius(c, number) } -> std::same_as<double>;

  // largest angle from the axis at which the model can be inverted, before distortion
  { Formula::limit_rad(c) } -> std::same_as<double>;

  // unit vector of a point before distortion: the inverse of radius()
  { Formula::direction(c, point) } -> std::same_as<Eigen::Vector3d>;

  // distortion at the squared radius r2; apply() gives the distorted point, jacobian() its derivative by the point
  { Formula::distortion(c, number).apply(point) } -> std::same_as<NormalisedPoint<double>>;
  { Formula::distortion(c, number).jacobian(point) } -> std::same_as<Eigen::Matrix2d>;
};

}  // namespace panvo::vision
