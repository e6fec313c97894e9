// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "panvo/binocular_odometry/parameters.hpp"
#include "panvo/vision/corner_detector.hpp"
#include "panvo/vision/image_pyramid.hpp"
#include "track.hpp"

namespace panvo::binocular_odometry {

/// A feature for a new track.
struct Feature {
  Eigen::Vector2d pixel;
  cv::Mat descriptor;  ///< empty for front ends without descriptors
};

/// Search start for a track: a pixel, and the coarsest pyramid level required by its uncertainty.
struct SearchStart {
  Eigen::Vector2d pixel;
  int level = 0;
};

/// Detects and matches features. Matches are refined by patch alignment afterwards.
class FrontEnd {
 public:
  virtual ~FrontEnd() = default;

  /// Sets the next left image.
  virtual void describe(const vision::ImagePyramid& image) = 0;

  /// Search start for a track near its expected pixel; nullopt if it is not found. May update the descriptor of the
  /// track.
  virtual std::optional<SearchStart> match(Track& track, const Eigen::Vector2d& expected_pixel) = 0;

  /// New features, at most one per free cell.
  virtual std::vector<Feature> detect(const vision::CellGrid& grid) = 0;
};

/// Creates the front end selected by the parameters. Throws std::invalid_argument for an unknown name.
std::unique_ptr<FrontEnd> make_front_end(const TrackingParameters& parameters);

}  // namespace panvo::binocular_odometry
