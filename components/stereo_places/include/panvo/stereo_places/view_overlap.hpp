// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/vision/camera.hpp"

namespace panvo::stereo_places {

/// Share of the points of a place (frame of its camera) that another pose of the camera sees at a similar scale: inside
/// the image, and at a distance that differs by less than a factor of 1.5, which SIFT bridges well. 0 without points.
double shared_view(std::span<const Eigen::Vector3d> points, const vision::PinholeCamera& camera,
                   const Eigen::Isometry3d& place_from_view);

/// The keypoints without those on the vehicle itself: near things that stayed at their bearing although the camera moved
/// and nothing else so near would have. `before`: keypoints of an earlier view; `before_from_now`: motion of the camera.
std::vector<landmarks::Keypoint> without_own_body(std::span<const landmarks::Keypoint> keypoints,
                                                  std::span<const landmarks::Keypoint> before,
                                                  const Eigen::Isometry3d& before_from_now);

}  // namespace panvo::stereo_places
