// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "panvo/vision/compressive_features.hpp"

namespace panvo::vision {

/// Gaussian that a feature's samples are fitted by [Lu2015 Eq. 6].
struct Gaussian {
  double mean = 0.0;
  double deviation = 0.0;  ///< sigma
};

Gaussian fit_gaussian(std::span<const float> samples);

/// h, 0 (the same) to 1 (apart) [Lu2015 Eq. 7]. Of two that do not vary at all: 0 where their means agree, else 1.
double hellinger_distance(const Gaussian& a, const Gaussian& b);

struct SelectionParameters {
  int kept = 100;          ///< n': features chosen
  double alpha_px = 8.0;   ///< positive samples lie nearer than this
  double beta_px = 16.0;   ///< negative samples lie farther than this ...
  double gamma_px = 64.0;  ///< ... and nearer than this
  double upright = 1.0;    ///< vertical share of these radii; 1: circles, as in the paper
  int sectors = 1;         ///< of the full turn: each gives its best kept/sectors first, so that no side is left out
  int samples = 16;        ///< of each of the two sets
  double smallest_deviation =
      0.02;  ///< of normalised responses: a patch whose four Gaussians are all narrower is dropped
};

/// One chosen feature.
struct SelectedFeature {
  int row = 0;          ///< of the matrix: its intensity; plus the number of rows: its SURF statistics
  float value = 0.0F;   ///< normalised response
  float spread = 1.0F;  ///< deviation of the response over the full turn: how different it is elsewhere
  float weight = 0.0F;  ///< h
};

/// The most discriminating features of a band, weights descending: intensity and SURF features ranked together by the Hellinger
/// distance between their responses close by and farther away [Lu2015 Eqs. 6-8]. Fewer than `kept` where too many patches see
/// nothing that varies.
std::vector<SelectedFeature> select_features(const CyclicIntegralImages& images, const MeasurementMatrix& matrix,
                                             const BandNormalisation& normalisation,
                                             const SelectionParameters& parameters, std::uint64_t seed);

}  // namespace panvo::vision
