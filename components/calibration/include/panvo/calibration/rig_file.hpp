// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "panvo/calibration/bundle.hpp"

namespace panvo::calibration {

/// A camera of a rig with the name of its camera_info file.
struct NamedCamera {
  std::string name;
  RigCamera camera;
};

/// Elevation range (degrees, upwards positive) in which the cameras together see all azimuths; nullopt if they do not
/// see the full horizon of the reference frame.
std::optional<std::pair<double, double>> seen_elevations_deg(const std::vector<NamedCamera>& cameras);

/// Text of extrinsics.yaml: the pose of each camera as a matrix in the reference frame, and as the driver parameter
/// `mount` (x, y, z in m; roll, pitch, yaw in degrees) on base_link, given the mount of the reference camera.
std::string extrinsics_text(const std::vector<NamedCamera>& cameras, std::size_t reference,
                            const Eigen::Matrix<double, 6, 1>& reference_mount);

/// Reads the cameras of an extrinsics.yaml with the lenses of the camera_info files in its folder. Throws
/// calibration_files::FileError with all problems.
std::vector<NamedCamera> read_extrinsics(const std::filesystem::path& file);

/// Text of a panorama.yaml for the panorama stitcher: orientation of the reference camera, centred between the cameras.
std::string panorama_text(const std::vector<NamedCamera>& cameras, std::size_t reference,
                          std::pair<double, double> seen_elevation_deg);

}  // namespace panvo::calibration
