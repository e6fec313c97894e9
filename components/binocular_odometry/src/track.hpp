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

/// A point of the scene followed from image to image, always by comparison with the patch of the frame it was first seen in (its
/// host), so that errors do not add up from frame to frame.
struct Track {
  std::int64_t id = 0;
  std::shared_ptr<const vision::ImagePyramid> host;  ///< left image of the host frame
  Eigen::Vector2d host_pixel;
  Eigen::Vector3d host_plane;         ///< n with n . X = 1 around the point, in the host's left frame
  Eigen::Isometry3d guide_from_host;  ///< the tracking stage's own dead reckoning
  Eigen::Vector2d gradient;           ///< disparity gradient expected in the last frame
  Observation seen;                   ///< in the last frame
  cv::Mat descriptor;                 ///< of a described feature; else empty
};

/// Where a track's patch is expected in another image, and how it is warped there.
struct ExpectedPatch {
  Eigen::Vector2d pixel;
  Eigen::Matrix2d current_from_host;  ///< of offsets from the centre
  double disparity_px = 0.0;
  Eigen::Vector2d gradient;  ///< of the disparity there
};

/// By the plane around the point and the motion since the host frame; nullopt when the point is behind, seen from the
/// back, or at less than a third or more than three times its size.
std::optional<ExpectedPatch> expect(const vision::RectifiedStereo& stereo, const Track& track,
                                    const Eigen::Isometry3d& current_from_host);

}  // namespace panvo::binocular_odometry
