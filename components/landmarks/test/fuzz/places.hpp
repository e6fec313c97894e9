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

/// A small describer with what it sees, made once: small matrices make rows that do not fit likely.
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

/// What a matcher does with a landmark that it took in: no value of it may lead beyond a matrix, or to what is no number.
inline void compare(const PanoramaDescription& description) {
  const auto& query = here().query;
  const float histogram = histogram_distance(query, description);
  const auto match = match_large_scale(query, description);
  const float small = small_scale_distance(query, description, match.heading_rad);
  if (!std::isfinite(histogram) || !std::isfinite(match.distance) || !std::isfinite(small)) std::abort();
}

}  // namespace panvo::landmarks::fuzz
