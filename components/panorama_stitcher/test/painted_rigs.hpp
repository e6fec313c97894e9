// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "panvo/panorama_stitcher/panorama_rig.hpp"
#include "panvo/vision/pose.hpp"

/// Typical rigs.
namespace panvo::panorama_stitcher {

inline constexpr double kDegree = std::numbers::pi / 180.0;

/// Pose panorama_from_head: turned right, then up, then about its axis; `outwards_m` from the centre along its axis.
inline Eigen::Isometry3d looking(double right_deg, double up_deg, double roll_deg, double outwards_m) {
  Eigen::Isometry3d panorama_from_head = Eigen::Isometry3d::Identity();
  panorama_from_head.linear() = vision::so3_exp({0.0, right_deg * kDegree, 0.0}) *
                                vision::so3_exp({up_deg * kDegree, 0.0, 0.0}) *
                                vision::so3_exp({0.0, 0.0, roll_deg * kDegree});
  panorama_from_head.translation() = outwards_m * panorama_from_head.linear().col(2);
  return panorama_from_head;
}

inline Head head_of(const std::string& name, std::size_t image, const vision::LensCamera& lens,
                    double field_of_view_deg, const Eigen::Isometry3d& panorama_from_head) {
  Head head{name, image, {}, {}, vision::CameraModel(lens, field_of_view_deg * kDegree), 0.0, panorama_from_head};
  head.image_size_px = {lens.pinhole.width, lens.pinhole.height};
  head.region_px = {{0, 0}, head.image_size_px};
  return head;
}

inline PanoramaRig rig_of(std::vector<Head> heads, double blend_deg = 6.0) {
  PanoramaRig rig;
  rig.heads = std::move(heads);
  rig.blend_rad = blend_deg * kDegree;
  rig.highest_rad = -std::numbers::pi / 2.0;
  rig.lowest_rad = std::numbers::pi / 2.0;
  return rig;
}

/// Two fisheyes of 195 degrees back to back, each with its own image.
inline PanoramaRig two_fisheyes(int size = 480) {
  const double focal_px = size / (196.0 * kDegree);
  const vision::LensCamera lens{{focal_px, focal_px, 0.5 * size - 0.3, 0.5 * size + 0.4, size, size},
                                vision::LensModel::kEquidistant,
                                {-0.01, 0.003, -0.001, 0.0001}};
  return rig_of({head_of("front", 0, lens, 190.0, looking(0.0, 0.0, 0.3, 0.01)),
                 head_of("back", 1, lens, 190.0, looking(180.0, 0.4, 90.0, 0.01))});
}

/// Five heads around, rotated by 90 degrees, and one upwards, as in a Ladybug; they do not see below -40 degrees.
inline PanoramaRig six_heads(int width = 404, int height = 308) {
  const double focal_px = width / (124.0 * kDegree);
  const vision::LensCamera lens{{focal_px, focal_px, 0.5 * width, 0.5 * height, width, height},
                                vision::LensModel::kEquidistant,
                                {-0.01, 0.003, 0.0, 0.0}};
  std::vector<Head> heads;
  for (int i = 0; i < 5; ++i)
    heads.push_back(head_of("around", heads.size(), lens, 0.0, looking(72.0 * i, 0.0, 90.0, 0.05)));
  heads.push_back(head_of("up", heads.size(), lens, 0.0, looking(0.0, 90.0, 0.0, 0.05)));
  PanoramaRig rig = rig_of(std::move(heads));
  rig.lowest_rad = 40.0 * kDegree;
  return rig;
}

}  // namespace panvo::panorama_stitcher
