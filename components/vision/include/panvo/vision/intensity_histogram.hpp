// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "panvo/vision/compressive_features.hpp"

namespace panvo::vision {

/// Shares of a band's grey levels (CV_8UC1, not empty) in `bins` equal bins, after normalisation: from -2 to 2 scales about the
/// offset, beyond that the outermost bins [Lu2015 4.2]. The same at every heading and for every gain and offset; sum 1.
std::vector<float> intensity_histogram(const cv::Mat& band, const BandNormalisation& normalisation, int bins);

/// Difference of two histograms of as many bins, 0 to 1: the earth mover's distance, in full ranges. Unlike a comparison bin by
/// bin it takes a slight change of brightness for what it is. Throws std::invalid_argument when their sizes differ.
float histogram_distance(std::span<const float> a, std::span<const float> b);

}  // namespace panvo::vision
