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

/// Where a head shows a direction.
struct HeadView {
  Eigen::Vector2d pixel;    ///< of the image the head is in; pixel centres at integer coordinates
  double margin_rad = 0.0;  ///< how far from the border of what the head sees
};

/// One camera of a panoramic rig: a lens, where it looks, and where in which image its picture is.
struct Head {
  std::string name;
  std::size_t image = 0;   ///< heads may share one: two fisheyes side by side, six pictures stacked
  cv::Size image_size_px;  ///< of that image
  cv::Rect region_px;      ///< the head's part of it; of the size that the lens was calibrated for
  std::variant<vision::CameraModel, vision::Equirectangular> lens;  ///< an equirectangular one sees all round
  double blind_spot_rad = 0.0;  ///< what a mirror does not show about its axis: the largest angle from it
  /// Of the head's optical frame in the panorama's (both X right, Y down, Z forward).
  Eigen::Isometry3d panorama_from_head = Eigen::Isometry3d::Identity();

  /// Where it shows the point `radius_m` (0: infinitely far) away in a direction (unit, panorama's frame); nullopt: it does not.
  std::optional<HeadView> see(const Eigen::Vector3d& direction_in_panorama, double radius_m) const;
};

/// Heads whose pictures together make a panorama.
struct PanoramaRig {
  std::string frame_id = "panorama_optical";
  std::vector<Head> heads;
  double blend_rad = 0.1;  ///< width of the strip along a seam in which both heads are seen
  double radius_m = 0.0;   ///< what is so far away joins without a step; 0: infinitely far
  /// Elevations, rad, downwards positive, all of which must be seen by some head; the rest may stay black.
  double highest_rad = 0.0, lowest_rad = 0.0;

  std::size_t images() const;  ///< one more than the largest Head::image
};

}  // namespace panvo::panorama_stitcher
