// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "panvo/simulated_world/camera_rays.hpp"
#include "panvo/simulation/sensor.hpp"
#include "panvo/vision/pose.hpp"
#include "panvo/vision/stereo_calibration.hpp"

namespace panvo::simulation {

enum class PanoramaKind { kEquirectangular, kSixHead, kDualFisheye };

/// A stereo camera with two equal eyes side by side.
struct StereoCamera {
  vision::StereoCalibration calibration;                             ///< raw images, distortion included
  Eigen::Isometry3d base_from_left = Eigen::Isometry3d::Identity();  ///< of the left optical frame
  double rate_hz = 25.0;
  double exposure_s = 0.003;
  SensorParameters sensor;

  Eigen::Isometry3d base_from_right() const { return base_from_left * calibration.right_from_left.inverse(); }
};

/// One camera of the panoramic camera: its only one, or one of several heads.
struct PanoramaHead {
  std::string frame_id;                                              ///< "panorama_optical", "panorama_head_0_optical"
  simulated_world::FisheyeCamera fisheye;                            ///< unused by an equirectangular camera
  Eigen::Isometry3d base_from_head = Eigen::Isometry3d::Identity();  ///< of its optical frame
  int width = 0, height = 0;                                         ///< px
};

struct PanoramicCamera {
  PanoramaKind kind = PanoramaKind::kEquirectangular;
  Eigen::Isometry3d base_from_panorama = Eigen::Isometry3d::Identity();
  std::vector<PanoramaHead> heads;  ///< one, two or six
  double rate_hz = 5.0;
  double exposure_s = 0.003;
  SensorParameters sensor;
};

struct Vehicle {
  bool has_body = true;         ///< whether its body is in the panoramas and casts a shadow
  double speed_m_per_s = 5.0;   ///< on straight roads
  bool turns_in_place = false;  ///< at junctions, as a robot with differential drive; else along arcs, as a car
};

/// The cameras on the vehicle (base_link: x forward, y left, z up, on the ground below the vehicle's centre).
struct Rig {
  StereoCamera stereo;
  PanoramicCamera panorama;
  Vehicle vehicle;
};

/// The rig of [Lu2015, section 7]: a stereo camera of 640 x 480 px at 25 Hz with a baseline of 0.12 m, directed forward
/// and down, and a panorama of 1080 x 540 px at 5 Hz above the roof.
Rig paper_rig();

/// Reads a rig file (config/rigs/paper/rig.yaml shows all keys; missing ones are as in paper_rig()). Throws
/// std::runtime_error with all problems, each with file, line and key: unknown keys, a baseline of zero, an impossible
/// field of view, rates and sizes that are not positive.
Rig read_rig(const std::filesystem::path& file);

simulated_world::CameraRays rays_of(const PanoramicCamera& camera, const PanoramaHead& head);

}  // namespace panvo::simulation
