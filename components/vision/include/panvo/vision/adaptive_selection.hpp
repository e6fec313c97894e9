// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "panvo/vision/compressive_features.hpp"

namespace panvo::vision {

/// Gaussian fitted to the samples of a feature [Lu2015 Eq. 6].
struct Gaussian {
  double mean = 0.0;
  double deviation = 0.0;  ///< sigma
};

Gaussian fit_gaussian(std::span<const float> samples);

/// Hellinger distance h, from 0 (identical) to 1 (disjoint) [Lu2015 Eq. 7]. If both deviations are zero: 0 for equal
/// means, else 1.
double hellinger_distance(const Gaussian& a, const Gaussian& b);

struct SelectionParameters {
  int kept = 100;          ///< n': number of selected features
  double alpha_px = 8.0;   ///< largest displacement of positive samples
  double beta_px = 16.0;   ///< smallest displacement of negative samples
  double gamma_px = 64.0;  ///< largest displacement of negative samples
  double upright = 1.0;    ///< ratio of vertical to horizontal displacement; 1: circles, as in the paper
  int sectors = 1;   ///< of the full turn; the best kept/sectors features of each are taken first, to cover all sides
  int samples = 16;  ///< per set
  double min_deviation = 0.02;  ///< of normalised responses; a patch is dropped if its four Gaussians are all narrower
};

/// One selected feature.
struct SelectedFeature {
  int row = 0;          ///< intensity feature: row of the matrix; SURF feature: row of the matrix + number of rows
  float value = 0.0F;   ///< normalised response
  float spread = 1.0F;  ///< standard deviation of the response over the full turn
  float weight = 0.0F;  ///< h
};

/// Selects the most discriminative features of a band, sorted by descending weight. Intensity and SURF features are
/// ranked together by the Hellinger distance between their positive and negative samples [Lu2015 Eqs. 6-8]. Returns
/// fewer than `kept` features if too many patches are uniform. Throws std::invalid_argument for parameters out of
/// range.
std::vector<SelectedFeature> select_features(const CyclicIntegralImages& images, const MeasurementMatrix& matrix,
                                             const BandNormalisation& normalisation,
                                             const SelectionParameters& parameters, std::uint64_t seed);

}  // namespace panvo::vision
