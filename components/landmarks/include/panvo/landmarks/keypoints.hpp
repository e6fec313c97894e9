// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

#include "panvo/landmarks/description_settings.hpp"
#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmarks {

struct KeypointParameters {
  int most = 250;              ///< keypoints kept: the strongest, spread over the azimuth
  bool half_size = true;       ///< detect in the image of half the size: a quarter of the time
  double top_deg = 35.0;       ///< search band, above the horizon
  double bottom_deg = 25.0;    ///< below the horizon
  double min_contrast = 0.02;  ///< of SIFT; OpenCV's 0.04 finds too few under overcast sky
  bool upright = true;         ///< descriptors keep the image's vertical: more distinctive, for tilts up to 15 degrees

  template <class Field>
  static void describe(Field&& field) {
    using P = KeypointParameters;
    field(&P::most, "most", "1", "SIFT features kept per panorama", 20, 5000);
    field(&P::half_size, "half_size", "", "detect SIFT features at half size: a quarter of the time");
    field(&P::top_deg, "top_deg", "deg", "upper limit of the search band, above the horizon", 5.0, 90.0);
    field(&P::bottom_deg, "bottom_deg", "deg", "lower limit of the search band, below the horizon", 0.0, 90.0);
    field(&P::min_contrast, "min_contrast", "1", "smallest contrast of a SIFT feature", 0.001, 0.2);
    field(&P::upright, "upright", "",
          "descriptors keep the image's vertical: more distinctive, for tilts up to 15 degrees");
  }
};

/// SIFT features of a panorama (CV_8UC1 or CV_8UC3, 2:1), strongest first, with bearings in the panorama frame. The
/// band is padded across the seam, so features there are found like any other. Throws std::invalid_argument for an
/// image that is empty, of another type or not 2:1. `mask`: CV_8UC1 of any size for the whole panorama, 0 where no
/// keypoint may lie or reach (the vehicle's body, parts that the camera does not see); empty: none.
std::vector<Keypoint> detect_keypoints(const cv::Mat& panorama, const KeypointParameters& parameters,
                                       const cv::Mat& mask = {});

/// Everything that must agree for two landmarks to be comparable: description, seed, kind of keypoints.
DescriptionSettings landmark_settings(const DescriptionParameters& description, const KeypointParameters& keypoints,
                                      std::uint64_t seed);

/// A pair of matched keypoints: indices into the two lists.
struct KeypointMatch {
  int query = 0;
  int landmark = 0;
  float distance = 0.0F;  ///< of the descriptors, Euclidean
};

/// Restricts matches to azimuth differences of at most `half_width_rad`, after the query is rotated to the landmark's
/// heading.
struct AzimuthWindow {
  double heading_rad = 0.0;  ///< from a HeadingMatch
  double half_width_rad = 0.35;
};

/// Mutual nearest-descriptor matches that pass the ratio test (`ratio`: nearest over second-nearest distance).
std::vector<KeypointMatch> match_keypoints(std::span<const Keypoint> query, std::span<const Keypoint> landmark,
                                           float ratio = 0.8F, const std::optional<AzimuthWindow>& window = {});

}  // namespace panvo::landmarks
