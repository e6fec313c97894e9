// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "front_end.hpp"

namespace panvo::binocular_odometry {

/// Corners, tracked by aligning their patches over the whole pyramid [Lucas and Kanade 1981; Bouguet 2000].
class KltFrontEnd final : public FrontEnd {
 public:
  explicit KltFrontEnd(const TrackingParameters& parameters) : parameters_(parameters) {}

  void describe(const vision::ImagePyramid& image) override { image_ = image; }

  std::optional<SearchStart> match(Track&, const Eigen::Vector2d& expected_pixel) override {
    return SearchStart{expected_pixel, image_.levels() - 1};
  }

  std::vector<Feature> detect(const vision::CellGrid& grid) override {
    std::vector<Feature> features;
    for (const auto& corner : vision::detect_corners(image_, grid, parameters_.min_gradient, kMargin_px)) {
      features.push_back({corner.position, {}});
    }
    return features;
  }

 private:
  static constexpr int kMargin_px = 8;  // half a patch and a border for its gradients

  TrackingParameters parameters_;
  vision::ImagePyramid image_;
};

}  // namespace panvo::binocular_odometry
