// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "panvo/evaluation/place_method.hpp"
#include "panvo/landmarks/panorama_describer.hpp"

namespace panvo::evaluation {

enum class FeatureScale { kLarge, kSmall };
enum class FeatureSelection {
  kPlain,    ///< CF: all sampled patches, intensity only, equal weights [Lu2015 3.1]
  kAdaptive  ///< ACF: the most distinctive patches, intensity or gradients, weighted [Lu2015 3.2]
};

/// panvo's compressive features as a method of Table 1, at one scale, matched over all headings.
std::unique_ptr<PlaceMethod> compressive_places(FeatureScale scale, FeatureSelection selection,
                                                const landmarks::DescriptionParameters& parameters, std::uint64_t seed);

}  // namespace panvo::evaluation
