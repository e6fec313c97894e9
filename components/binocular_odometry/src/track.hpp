// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "panvo/binocular_odometry/tracked_frame.hpp"
#include "panvo/vision/image_pyramid.hpp"
#include "panvo/vision/stereo_geometry.hpp"

namespace panvo::binocular_odometry {

/// A tracked scene point. Its patch is always taken from the frame in which it was first seen (its host), so that
/// errors do not accumulate.
struct Track {
  std::int64_t id = 0;
  std::shared_ptr<const vision::ImagePyramid> host;  ///< left image of the host frame
  Eigen::Vector2d host_pixel;
  Eigen::Vector3d host_plane;        ///< tangent plane n with n . X = 1, in the host's left frame
  Eigen::Isometry3d odom_from_host;  ///< in the dead-reckoning frame of the tracking stage
  Eigen::Vector2d gradient;          ///< expected disparity gradient in the last frame
  Observation seen;                  ///< in the last frame
  cv::Mat descriptor;                ///< empty for features without descriptor
};

/// Expected position and warp of a track's patch in another image.
struct ExpectedPatch {
  Eigen::Vector2d pixel;
  Eigen::Matrix2d current_from_host;  ///< maps offsets from the patch centre
  double disparity_px = 0.0;
  Eigen::Vector2d gradient;  ///< of the disparity
};

/// Predicts a patch from its tangent plane and the motion since the host frame. Returns nullopt if the point is behind
/// the camera, outside the image or seen from the back, or if its scale is below 1/3 or above 3.
std::optional<ExpectedPatch> expect(const vision::RectifiedStereo& stereo, const Track& track,
                                    const Eigen::Isometry3d& current_from_host);

}  // namespace panvo::binocular_odometry
