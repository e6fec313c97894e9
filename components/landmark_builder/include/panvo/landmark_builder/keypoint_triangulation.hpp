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
  double farthest_m = 200.0;
  double fewest_sigmas = 3.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = TriangulationParameters;
    field(&P::descriptor_ratio, "descriptor_ratio", "1",
          "a match's descriptor distance, of that of the second best, at most", 0.3, 1.0);
    field(&P::bearing_sigma_deg, "bearing_sigma_deg", "deg", "standard deviation of a keypoint's bearing", 0.01, 2.0);
    field(&P::gate_sigmas, "gate_sigmas", "1", "how far a bearing may lie from where its point is seen", 1.0, 10.0);
    field(&P::farthest_m, "farthest_m", "m", "points farther away are none", 5.0, 10000.0);
    field(&P::fewest_sigmas, "fewest_sigmas", "1",
          "how many standard deviations a point's inverse range must lie above 0", 1.0, 20.0);
  }
};

/// A panorama taken near the landmark's, and where: panorama frames, metric, as the odometry knows it.
struct NeighbourPanorama {
  Eigen::Isometry3d landmark_from_neighbour = Eigen::Isometry3d::Identity();
  std::vector<landmarks::Keypoint> keypoints;
};

/// Gives the landmark's keypoints their points: matched in each neighbour near the heading between the two, on the epipolar plane and
/// before both; then the inverse range along the landmark's bearing that fits all of them best, with its standard deviation. A
/// keypoint of which the neighbours disagree, or that shows no parallax, gets none. Returns how many have one.
int triangulate_keypoints(std::span<landmarks::Keypoint> landmark, std::span<const NeighbourPanorama> neighbours,
                          const TriangulationParameters& parameters);

}  // namespace panvo::landmark_builder
