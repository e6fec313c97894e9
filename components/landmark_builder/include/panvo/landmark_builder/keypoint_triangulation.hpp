// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmark_builder {

struct TriangulationParameters {
  double descriptor_ratio = 0.8;
  double bearing_sigma_deg = 0.25;
  double gate_sigmas = 3.0;
  double max_range_m = 200.0;
  double min_sigmas = 3.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = TriangulationParameters;
    field(&P::descriptor_ratio, "descriptor_ratio", "1",
          "largest ratio of a match's descriptor distance to the second best", 0.3, 1.0);
    field(&P::bearing_sigma_deg, "bearing_sigma_deg", "deg", "standard deviation of a keypoint's bearing", 0.01, 2.0);
    field(&P::gate_sigmas, "gate_sigmas", "1", "largest deviation of a bearing from its point, in standard deviations",
          1.0, 10.0);
    field(&P::max_range_m, "max_range_m", "m", "points farther away are discarded", 5.0, 10000.0);
    field(&P::min_sigmas, "min_sigmas", "1", "smallest inverse range of a point, in standard deviations", 1.0, 20.0);
  }
};

/// A panorama near the landmark's and its pose by odometry, in panorama frames, m.
struct NeighbourPanorama {
  Eigen::Isometry3d landmark_from_neighbour = Eigen::Isometry3d::Identity();
  std::vector<landmarks::Keypoint> keypoints;
};

/// Triangulates the landmark's keypoints: matches them in each neighbour near the relative heading, then fits the
/// inverse range along the landmark's bearing to all matches by least squares, with its standard deviation. Keypoints
/// with inconsistent matches or without parallax get no point. Returns the number of keypoints with a point.
int triangulate_keypoints(std::span<landmarks::Keypoint> landmark, std::span<const NeighbourPanorama> neighbours,
                          const TriangulationParameters& parameters);

}  // namespace panvo::landmark_builder
