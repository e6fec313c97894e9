// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <opencv2/core.hpp>

#include "panvo/landmarks/landmark_distance.hpp"
#include "panvo/landmarks/landmark_library.hpp"
#include "panvo/landmarks/panorama_describer.hpp"

namespace panvo::landmarks::fuzz {

/// A small describer and a query, created once. Small matrices make out-of-range rows likely.
struct Here {
  static DescriptionParameters parameters() {
    DescriptionParameters parameters;
    parameters.patches = 20;
    parameters.features = 10;
    parameters.headings = 12;
    parameters.histogram_bins = 8;
    return parameters;
  }
  static cv::Mat noise() {
    cv::Mat panorama(540, 1080, CV_8UC1);
    cv::RNG(1).fill(panorama, cv::RNG::UNIFORM, 0, 256);
    return panorama;
  }

  PanoramaDescriber describer{parameters(), 1};
  QueryDescription query = describer.query(noise());
  DescriptionSettings settings = description_settings(parameters(), 1);
};

inline const Here& here() {
  static const Here made;
  return made;
}

/// Compares like a matcher: no value may lead to an index out of range or to a result that is not finite.
inline void compare(const PanoramaDescription& description) {
  const auto& query = here().query;
  const float histogram = histogram_distance(query, description);
  const auto match = match_large_scale(query, description);
  const float small = small_scale_distance(query, description, match.heading_rad);
  if (!std::isfinite(histogram) || !std::isfinite(match.distance) || !std::isfinite(small)) std::abort();
}

}  // namespace panvo::landmarks::fuzz
