// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rig_settings.hpp"

namespace panvo::simulation {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

/// Optical axes (X right, Y down, Z forward) of a camera whose Z points along base_link's x.
Eigen::Matrix3d base_from_optical() {
  Eigen::Matrix3d rotation;
  rotation << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return rotation;
}

/// A camera turned left by yaw, downwards by pitch, clockwise by roll.
Eigen::Isometry3d looking(const Eigen::Vector3d& position_m, double yaw_rad, double pitch_rad, double roll_rad) {
  Eigen::Isometry3d base_from_camera = Eigen::Isometry3d::Identity();
  base_from_camera.linear() =
      (Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()))
          .toRotationMatrix() *
      base_from_optical();
  base_from_camera.translation() = position_m;
  return base_from_camera;
}

StereoCamera build(const StereoSettings& settings) {
  StereoCamera stereo;
  const double focal_px = 0.5 * settings.width / std::tan(0.5 * settings.field_of_view_deg * kRadians);
  vision::LensCamera eye;
  eye.pinhole = {focal_px,
                 focal_px,
                 0.5 * (settings.width - 1) + settings.principal_point_offset_px[0],
                 0.5 * (settings.height - 1) + settings.principal_point_offset_px[1],
                 settings.width,
                 settings.height};
  std::copy(settings.distortion.begin(), settings.distortion.end(), eye.distortion.begin());
  stereo.calibration.left = stereo.calibration.right = eye;
  Eigen::Isometry3d left_from_right = Eigen::Isometry3d::Identity();
  left_from_right.linear() = vision::so3_exp(kRadians * settings.right_rotation_deg);
  left_from_right.translation().x() = settings.baseline_m;
  stereo.calibration.right_from_left = left_from_right.inverse();
  stereo.base_from_left = looking(settings.position_m, kRadians * settings.yaw_deg, kRadians * settings.pitch_deg,
                                  kRadians * settings.roll_deg);
  stereo.rate_hz = settings.rate_hz;
  stereo.exposure_s = 1e-3 * settings.exposure_ms;
  stereo.sensor.colour = settings.colour;
  stereo.sensor.metered_from = 0.35;  // the road and its surroundings
  return stereo;
}

/// Five heads around and one up, as in a Ladybug; the lens centres lie on a circle, because they cannot coincide.
std::vector<PanoramaHead> six_heads(const PanoramaSettings& settings, const Eigen::Isometry3d& base_from_mount) {
  std::vector<PanoramaHead> heads;
  for (int i = 0; i < 6; ++i) {
    PanoramaHead head;
    head.frame_id = fmt::format("panorama_head_{}_optical", i);
    head.width = settings.width;
    head.height = settings.height;
    const double yaw_rad = -2.0 * std::numbers::pi * i / 5.0;
    const Eigen::Vector3d outwards(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
    head.base_from_head =
        i < 5 ? base_from_mount * looking(settings.head_radius_m * outwards, yaw_rad, 0.0, 0.0)
              : base_from_mount * looking({0.0, 0.0, settings.head_radius_m}, 0.0, -0.5 * std::numbers::pi, 0.0);
    // 72 degrees between heads, plus the diagonal to the corners and some overlap for blending.
    const double focal_px = settings.width / (100.0 * kRadians);
    head.fisheye.pinhole = {focal_px,       focal_px,       0.5 * (settings.width - 1), 0.5 * (settings.height - 1),
                            settings.width, settings.height};
    head.fisheye.field_of_view_rad = 170.0 * kRadians;
    heads.push_back(head);
  }
  return heads;
}

/// Two fisheyes back to back, each with a field of view slightly larger than a hemisphere.
std::vector<PanoramaHead> two_fisheyes(const PanoramaSettings& settings, const Eigen::Isometry3d& base_from_mount) {
  constexpr double kFieldOfViewRad = 200.0 * kRadians;
  std::vector<PanoramaHead> heads;
  for (int i = 0; i < 2; ++i) {
    PanoramaHead head;
    head.frame_id = fmt::format("panorama_head_{}_optical", i);
    head.width = settings.width;
    head.height = settings.height;
    const double yaw_rad = std::numbers::pi * i;
    const Eigen::Vector3d outwards(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
    head.base_from_head = base_from_mount * looking(settings.head_radius_m * outwards, yaw_rad, 0.0, 0.0);
    const double focal_px = std::min(settings.width, settings.height) / kFieldOfViewRad;
    head.fisheye.pinhole = {focal_px,       focal_px,       0.5 * (settings.width - 1), 0.5 * (settings.height - 1),
                            settings.width, settings.height};
    head.fisheye.field_of_view_rad = kFieldOfViewRad;
    heads.push_back(head);
  }
  return heads;
}

PanoramicCamera build(const PanoramaSettings& settings) {
  PanoramicCamera panorama;
  panorama.kind = settings.kind;
  panorama.rate_hz = settings.rate_hz;
  panorama.exposure_s = 1e-3 * settings.exposure_ms;
  panorama.sensor.colour = settings.colour;
  if (settings.kind == PanoramaKind::kEquirectangular) {  // excludes the sky and the vehicle's roof
    panorama.sensor.metered_from = 0.38;
    panorama.sensor.metered_to = 0.62;
  }
  panorama.base_from_panorama = looking(settings.position_m, kRadians * settings.yaw_deg, kRadians * settings.pitch_deg,
                                        kRadians * settings.roll_deg);
  Eigen::Isometry3d base_from_mount = panorama.base_from_panorama;
  base_from_mount.linear() = base_from_mount.linear() * base_from_optical().transpose();
  switch (settings.kind) {
    case PanoramaKind::kEquirectangular:
      panorama.heads.push_back({"panorama_optical", {}, panorama.base_from_panorama, settings.width, settings.height});
      break;
    case PanoramaKind::kSixHead:
      panorama.heads = six_heads(settings, base_from_mount);
      break;
    case PanoramaKind::kDualFisheye:
      panorama.heads = two_fisheyes(settings, base_from_mount);
      break;
  }
  return panorama;
}

}  // namespace

Rig paper_rig() { return {build(StereoSettings{}), build(PanoramaSettings{}), Vehicle{}}; }

Rig read_rig(const std::filesystem::path& file) {
  const auto settings = read_rig_settings(file);
  return {build(settings.stereo), build(settings.panorama), settings.vehicle};
}

simulated_world::CameraRays rays_of(const PanoramicCamera& camera, const PanoramaHead& head) {
  return camera.kind == PanoramaKind::kEquirectangular ? simulated_world::panorama_rays(head.width, head.height)
                                                       : simulated_world::fisheye_rays(head.fisheye);
}

}  // namespace panvo::simulation
