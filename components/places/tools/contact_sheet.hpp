// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "panvo/places/place_finder.hpp"

namespace panvo::places {

/// A query above its place, turned to the same heading; lines join the most similar keypoints that agree. BGR.
cv::Mat draw_match(const PanoramaImage& query, const PlaceAnswer& answer, const std::vector<KnownPlace>& places,
                   const std::string& title);

}  // namespace panvo::places
