// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmarks {

/// A landmark as people can judge it [Lu2015 Fig. 3]: its panorama, once with the `count` most discriminative features of the
/// large scale and once with those of the small one. Red rectangles: intensity, blue ones: SURF statistics; thin where they
/// count negative. The number is the feature's rank, then its weight. Features that the basis does not have are left out.
cv::Mat draw_landmark(const PanoramicLandmark& landmark, const DescriptionBasis& basis, int count);

/// Where landmarks lie, the map's x to the right and y upwards: junctions filled, others hollow, a stroke where the vehicle
/// headed, the ellipse in which the landmark lies with a probability of 95 %.
cv::Mat draw_map(std::span<const PanoramicLandmark> landmarks);

}  // namespace panvo::landmarks
