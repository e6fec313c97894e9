// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <variant>

#include "panvo/vision/lens_models/equidistant.hpp"
#include "panvo/vision/lens_models/mei.hpp"
#include "panvo/vision/lens_models/plumb_bob.hpp"
#include "panvo/vision/lens_models/rational.hpp"

namespace panvo::vision {

/// All lens models. Names, projection, calibration and files take them from here, in this order.
using LensFormulas = std::variant<PlumbBobLens, RationalLens, EquidistantLens, MeiLens>;

template <LensFormula Formula>
inline constexpr std::size_t kLensPlace = LensFormulas(Formula()).index();

enum class LensModel : std::size_t {
  kPlumbBob = kLensPlace<PlumbBobLens>,
  kRational = kLensPlace<RationalLens>,
  kEquidistant = kLensPlace<EquidistantLens>,
  kMei = kLensPlace<MeiLens>,
};

template <LensFormula Formula>
inline constexpr LensModel kLensModel = static_cast<LensModel>(kLensPlace<Formula>);

inline constexpr auto kLensModels = []<std::size_t... kPlaces>(std::index_sequence<kPlaces...> /*places*/) {
  return std::array{static_cast<LensModel>(kPlaces)...};
}
(std::make_index_sequence<std::variant_size_v<LensFormulas>>());

/// function(formula), where `formula` is an object of the model's type. Every model takes part, so `function` must
/// accept all of them. Throws std::out_of_range for a value that is no model.
template <class Function>
decltype(auto) visit_lens(LensModel model, Function&& function) {
  static constexpr auto kFormulas = []<std::size_t... kPlaces>(std::index_sequence<kPlaces...> /*places*/) {
    return std::array{LensFormulas(std::in_place_index<kPlaces>)...};
  }
  (std::make_index_sequence<std::variant_size_v<LensFormulas>>());
  return std::visit(std::forward<Function>(function), kFormulas.at(static_cast<std::size_t>(model)));
}

inline constexpr std::size_t kMaxLensCoefficients = []<class... Formulas>(const std::variant<Formulas...>& /*all*/) {
  return std::max({Formulas::kCoefficients.size()...});
}(LensFormulas());

}  // namespace panvo::vision
