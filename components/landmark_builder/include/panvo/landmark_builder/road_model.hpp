// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "panvo/landmark_builder/colour_mixture.hpp"

namespace panvo::landmark_builder {

struct RoadModelParameters {
  int gaussians = 5;
  double learning_rate = 0.05;
  double min_weight = 0.02;
  double threshold = -4.5;

  template <class Field>
  static void describe(Field&& field) {
    using P = RoadModelParameters;
    field(&P::gaussians, "gaussians", "1", "modes of the road's colour: asphalt in sun and shadow, patches, markings",
          1, 20);
    field(&P::learning_rate, "learning_rate", "1", "fraction of the model that one panorama replaces", 0.001, 1.0);
    field(&P::min_weight, "min_weight", "1", "fraction of the samples below which a mode is ignored", 0.0, 0.5);
    field(&P::threshold, "threshold", "1",
          "log density, relative to the best road colour, below which a colour is not road", -50.0, 0.0);
  }
};

/// Appearance of the road, learned online from ground that is known to be road [Lu2015 4.1].
class RoadModel {
 public:
  explicit RoadModel(const RoadModelParameters& parameters);

  /// Learns from the pixels of a bird's-eye view (8UC1 or 8UC3) that are set in `certain` (8UC1, same size).
  void learn(const cv::Mat& view, const cv::Mat& certain);

  /// Log ratio of road to not road for every pixel, in [-3, 3] (32FC1); all 0 before the first training.
  cv::Mat segment(const cv::Mat& view) const;

  const ColourMixture& road() const noexcept { return road_; }
  const ColourMixture& surroundings() const noexcept { return surroundings_; }

 private:
  RoadModelParameters parameters_;
  ColourMixture road_, surroundings_;
  bool has_colour_ = false;
};

}  // namespace panvo::landmark_builder
