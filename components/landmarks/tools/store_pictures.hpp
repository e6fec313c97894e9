// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmarks {

/// Picture of a landmark [Lu2015 Fig. 3]: its panorama twice, with the `count` most discriminative features of the
/// large scale and of the small scale. Red rectangles: intensity; blue: SURF statistics; thin: negative sign. Labels:
/// rank and weight of the feature. Features outside the basis are skipped.
cv::Mat draw_landmark(const PanoramicLandmark& landmark, const DescriptionBasis& basis, int count);

/// Map of landmarks, x to the right and y up: junctions filled, others hollow, a line for the vehicle's heading, and
/// the 95 % confidence ellipse of the position.
cv::Mat draw_map(std::span<const PanoramicLandmark> landmarks);

}  // namespace panvo::landmarks
