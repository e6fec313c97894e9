// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "panvo/vision/camera_model.hpp"
#include "panvo/vision/equirectangular.hpp"

namespace panvo::panorama_stitcher {

/// Projection of a direction into a head.
struct HeadView {
  Eigen::Vector2d pixel;    ///< in the head's image; pixel centres at integer coordinates
  double margin_rad = 0.0;  ///< angle to the border of the head's field of view
};

/// One camera of a panoramic rig: lens, pose, and region in an image.
struct Head {
  std::string name;
  std::size_t image = 0;   ///< index; heads may share an image, e.g. two fisheyes side by side, six views stacked
  cv::Size image_size_px;  ///< of that image
  cv::Rect region_px;      ///< the head's part of the image, of the size the lens was calibrated for
  std::variant<vision::CameraModel, vision::Equirectangular> lens;  ///< an equirectangular one sees all directions
  double blind_spot_rad = 0.0;  ///< half angle of the blind spot around a mirror's axis
  /// Pose of the head's optical frame in the panorama frame (both X right, Y down, Z forward).
  Eigen::Isometry3d panorama_from_head = Eigen::Isometry3d::Identity();

  /// Projects the point at distance `radius_m` (0: infinity) in a direction (unit vector, panorama frame); nullopt if
  /// the head does not see it.
  std::optional<HeadView> see(const Eigen::Vector3d& direction_in_panorama, double radius_m) const;
};

/// Heads that together make a panorama.
struct PanoramaRig {
  std::string frame_id = "panorama_optical";
  std::vector<Head> heads;
  double blend_rad = 0.1;  ///< width of the blended strip along a seam
  double radius_m = 0.0;   ///< distance at which objects join without a step; 0: infinity
  /// Elevation range, rad, downwards positive, that the heads must cover; the rest may stay black.
  double highest_rad = 0.0, lowest_rad = 0.0;

  std::size_t images() const;  ///< one more than the largest Head::image
};

}  // namespace panvo::panorama_stitcher
