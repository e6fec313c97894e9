// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "panvo/calibration/bundle.hpp"

namespace panvo::calibration {

/// A camera of a rig under the name of its camera_info file.
struct NamedCamera {
  std::string name;
  RigCamera camera;
};

/// Lowest and highest elevation (degrees, upwards positive) between which cameras see all directions round about; nullopt: not even the
/// horizon of the reference's frame.
std::optional<std::pair<double, double>> seen_elevations_deg(const std::vector<NamedCamera>& cameras);

/// extrinsics.yaml: pose of each camera, as a matrix in the frame of the first camera and as the `mount` of a driver (x, y, z in m; roll, pitch,
/// yaw in degrees) on base_link, on which the reference has the mount given.
std::string extrinsics_text(const std::vector<NamedCamera>& cameras, std::size_t reference,
                            const Eigen::Matrix<double, 6, 1>& reference_mount);

/// The cameras of an extrinsics.yaml, with the lenses of the camera_info files beside it. Throws CalibrationError, naming file, line and key.
std::vector<NamedCamera> read_extrinsics(const std::filesystem::path& file);

/// panorama.yaml of the panorama stitcher: looks where the reference looks, from the middle of the cameras.
std::string panorama_text(const std::vector<NamedCamera>& cameras, std::size_t reference,
                          std::pair<double, double> seen_elevation_deg);

}  // namespace panvo::calibration
