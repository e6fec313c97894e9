// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/lens.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace panvo::vision {
namespace {

/// "plumb_bob (k1 k2 p1 p2 k3), ... and mei (k1 k2 p1 p2 xi)"
std::string supported_models() {
  std::ostringstream text;
  for (std::size_t i = 0; i < kLensModels.size(); ++i) {
    if (i > 0) text << (i + 1 < kLensModels.size() ? ", " : " and ");
    text << ros_name(kLensModels[i]);
    const char* before = " (";
    for (const auto& coefficient : lens_coefficients(kLensModels[i])) {
      text << before << coefficient.name;
      before = " ";
    }
    text << ")";
  }
  return text.str();
}

[[noreturn]] void refuse(std::string_view name, std::size_t count) {
  std::ostringstream text;
  text << "has distortion model '" << name << "' with " << count << " coefficients; supported are "
       << supported_models() << ": calibrate with one of them";
  throw std::invalid_argument(text.str());
}

/// How many coefficients a file must give.
std::size_t min_count(LensModel model) {
  const auto all = lens_coefficients(model);
  const auto last =
      std::find_if(all.rbegin(), all.rend(), [](const auto& coefficient) { return !coefficient.is_optional; });
  return static_cast<std::size_t>(all.rend() - last);
}

/// The simplest model that is the same lens if the coefficients after the first `used` are zero.
LensModel simplest(LensModel model, std::size_t used) {
  return visit_lens(model, [&]<class Formula>(const Formula& /*formula*/) {
    if constexpr (requires { typename Formula::Simpler; }) {
      using Simpler = typename Formula::Simpler;
      if (used <= Simpler::kCoefficients.size()) return kLensModel<Simpler>;
    }
    return kLensModel<Formula>;
  });
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
  const auto model = find_lens_model(distortion_model);
  if (!model && used.empty()) return camera;  // no model needed without distortion
  if (!model || used.size() > lens_coefficients(*model).size() || coefficients.size() < min_count(*model))
    refuse(distortion_model, coefficients.size());
  camera.model = simplest(*model, used.size());
  std::copy(used.begin(), used.end(), camera.distortion.begin());
  return camera;
}

bool is_straight(const LensCamera& camera) {
  return visit_lens(camera.model, [](const auto& formula) { return formula.kIsPerspective; }) &&
         std::all_of(camera.distortion.begin(), camera.distortion.end(), [](double value) { return value == 0.0; });
}

std::string_view ros_name(LensModel model) {
  return visit_lens(model, [](const auto& formula) { return formula.kName; });
}

std::optional<LensModel> find_lens_model(std::string_view name) {
  const auto* const found = std::find_if(kLensModels.begin(), kLensModels.end(), [&](LensModel model) {
    return visit_lens(model, [&](const auto& formula) {
      const auto& aliases = formula.kAliases;
      return formula.kName == name || std::find(aliases.begin(), aliases.end(), name) != aliases.end();
    });
  });
  if (found == kLensModels.end()) return std::nullopt;
  return *found;
}

std::span<const LensCoefficient> lens_coefficients(LensModel model) {
  return visit_lens(model, []<class Formula>(const Formula& /*formula*/) {
    return std::span<const LensCoefficient>(Formula::kCoefficients);
  });
}

std::vector<double> ros_coefficients(const LensCamera& camera) {
  const auto count = static_cast<std::ptrdiff_t>(lens_coefficients(camera.model).size());
  return {camera.distortion.begin(), camera.distortion.begin() + count};
}

}  // namespace panvo::vision
