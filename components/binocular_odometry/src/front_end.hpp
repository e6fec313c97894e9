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

/// A feature worth a new track.
struct Feature {
  Eigen::Vector2d pixel;
  cv::Mat descriptor;  ///< empty where features are not described
};

/// Where to look for a track: a pixel, and the coarsest pyramid level whose reach its uncertainty needs.
struct Whereabouts {
  Eigen::Vector2d pixel;
  int level = 0;
};

/// How features are found, and found again. The exact place of a match is left to patch alignment in either case.
class FrontEnd {
 public:
  virtual ~FrontEnd() = default;

  /// Takes up the next left image.
  virtual void describe(const vision::ImagePyramid& image) = 0;

  /// Where the track may be, given where it is expected; nullopt when it is not seen. May renew the track's descriptor.
  virtual std::optional<Whereabouts> match(Track& track, const Eigen::Vector2d& expected_pixel) = 0;

  /// New features, one in each free cell that has any.
  virtual std::vector<Feature> detect(const vision::CellGrid& grid) = 0;
};

/// The front end that the parameters name.
std::unique_ptr<FrontEnd> make_front_end(const TrackingParameters& parameters);

}  // namespace panvo::binocular_odometry
