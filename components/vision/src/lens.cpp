// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/lens.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace panvo::vision {
namespace {

struct Name {
  std::string_view text;
  LensModel model;
};

constexpr std::array kNames{
    Name{"plumb_bob", LensModel::kPlumbBob},      Name{"rational_polynomial", LensModel::kRational},
    Name{"equidistant", LensModel::kEquidistant}, Name{"mei", LensModel::kMei},
    Name{"radtan", LensModel::kPlumbBob},         Name{"radial-tangential", LensModel::kPlumbBob},
    Name{"fisheye", LensModel::kEquidistant},     Name{"omni-radtan", LensModel::kMei}};

std::size_t coefficients_of(LensModel model) {
  switch (model) {
    case LensModel::kRational:
      return 8;
    case LensModel::kEquidistant:
      return 4;
    case LensModel::kPlumbBob:
    case LensModel::kMei:
      break;
  }
  return 5;
}

std::optional<LensModel> find(std::string_view name) {
  const auto* const found =
      std::find_if(kNames.begin(), kNames.end(), [&](const Name& known) { return known.text == name; });
  if (found == kNames.end()) return std::nullopt;
  return found->model;
}

[[noreturn]] void refuse(std::string_view name, std::size_t count) {
  std::ostringstream text;
  text << "has distortion model '" << name << "' with " << count
       << " coefficients; supported are plumb_bob (k1 k2 p1 p2 k3), rational_polynomial (k1 k2 p1 p2 k3 k4 k5 k6), "
          "equidistant (k1 k2 k3 k4) and mei (k1 k2 p1 p2 xi): calibrate with one of them";
  throw std::invalid_argument(text.str());
}

}  // namespace

LensCamera lens_camera(std::string_view distortion_model, std::span<const double> coefficients,
                       const PinholeCamera& pinhole) {
  LensCamera camera;
  camera.pinhole = pinhole;
  if (!std::all_of(coefficients.begin(), coefficients.end(), [](double value) { return std::isfinite(value); }))
    throw std::invalid_argument("has a distortion coefficient that is not a number; calibrate again");
  const auto last = std::find_if(coefficients.rbegin(), coefficients.rend(), [](double value) { return value != 0.0; });
  const auto used = coefficients.first(static_cast<std::size_t>(coefficients.rend() - last));
  const auto model = find(distortion_model);
  if (!model && used.empty()) return camera;  // no model needed without distortion
  if (!model || used.size() > coefficients_of(*model)) refuse(distortion_model, coefficients.size());
  camera.model = *model;
  if (*model == LensModel::kMei && coefficients.size() < 5) refuse(distortion_model, coefficients.size());  // no xi
  std::copy(used.begin(), used.end(), camera.distortion.begin());
  if (*model == LensModel::kMei) std::swap(camera.xi, camera.distortion[4]);
  // without denominator terms it is a plumb_bob lens
  if (*model == LensModel::kRational && used.size() <= 5) camera.model = LensModel::kPlumbBob;
  return camera;
}

bool is_straight(const LensCamera& camera) {
  const bool is_perspective = camera.model == LensModel::kPlumbBob || camera.model == LensModel::kRational;
  return is_perspective &&
         std::all_of(camera.distortion.begin(), camera.distortion.end(), [](double value) { return value == 0.0; });
}

std::string_view ros_name(LensModel model) {
  const auto* const found =
      std::find_if(kNames.begin(), kNames.end(), [&](const Name& known) { return known.model == model; });
  return found->text;
}

std::vector<double> ros_coefficients(const LensCamera& camera) {
  std::vector<double> coefficients(camera.distortion.begin(),
                                   camera.distortion.begin() + static_cast<int>(coefficients_of(camera.model)));
  if (camera.model == LensModel::kMei) coefficients[4] = camera.xi;
  return coefficients;
}

}  // namespace panvo::vision
