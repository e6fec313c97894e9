// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>

#include "panvo/simulation/rig.hpp"

namespace panvo::simulation {

/// The stereo camera's settings in a rig file, in user units; the defaults are the paper's rig.
struct StereoSettings {
  double rate_hz = 25.0;
  int width = 640, height = 480;
  double field_of_view_deg = 77.0;  ///< horizontal, of the undistorted image
  double baseline_m = 0.12;
  Eigen::Vector3d position_m{1.9, 0.06, 1.3};                    ///< of the left eye in base_link
  double yaw_deg = 0.0, pitch_deg = 12.0, roll_deg = 0.0;        ///< left, downwards, clockwise
  Eigen::Vector2d principal_point_offset_px{-0.9, 1.7};          ///< from the image centre, as in real cameras
  std::array<double, 5> distortion{};                            ///< k1 k2 p1 p2 k3
  Eigen::Vector3d right_rotation_deg = Eigen::Vector3d::Zero();  ///< rotation vector, right eye relative to the left
  double exposure_ms = 3.0;
  bool colour = false;
};

struct PanoramaSettings {
  PanoramaKind kind = PanoramaKind::kEquirectangular;
  double rate_hz = 5.0;
  int width = 1080, height = 540;  ///< of the panorama, or of each head
  Eigen::Vector3d position_m{-0.25, 0.0, 2.02};
  double yaw_deg = 0.0, pitch_deg = 0.0, roll_deg = 0.0;
  double head_radius_m = 0.04;  ///< of the heads' optical centres around the camera's centre
  double exposure_ms = 3.0;
  bool colour = true;
};

struct RigSettings {
  StereoSettings stereo;
  PanoramaSettings panorama;
  Vehicle vehicle;
};

/// Throws std::runtime_error as read_rig() does.
RigSettings read_rig_settings(const std::filesystem::path& file);

}  // namespace panvo::simulation
