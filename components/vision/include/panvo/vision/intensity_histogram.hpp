// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "panvo/vision/compressive_features.hpp"

namespace panvo::vision {

/// Normalised grey-level histogram (sum 1) of a band (CV_8UC1, not empty) [Lu2015 4.2]: `bins` equal bins from -2 to 2
/// scales about the offset; values beyond fall into the outermost bins. Invariant to heading, gain and offset.
std::vector<float> intensity_histogram(const cv::Mat& band, const BandNormalisation& normalisation, int bins);

/// Earth mover's distance between two histograms, 0 to 1 (in units of the full range). Unlike a bin-wise comparison, it
/// stays small for a slight change of brightness. Throws std::invalid_argument if their sizes differ.
float histogram_distance(std::span<const float> a, std::span<const float> b);

}  // namespace panvo::vision
