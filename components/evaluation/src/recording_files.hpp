// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <vector>

#include "panvo/evaluation/place_recording.hpp"

namespace panvo::evaluation {

/// Of OpenCV's spelling, too. Throws InputError where it cannot be read or understood.
YAML::Node read_yaml(const std::filesystem::path& file);

/// T_BS of an EuRoC/ASL sensor.yaml. Throws InputError.
Eigen::Isometry3d read_extrinsics(const std::filesystem::path& file);

/// The images of a folder that are named by their stamp, in order; poses and way as yet unknown. Throws InputError for none.
std::vector<RecordedPanorama> list_panoramas(const std::filesystem::path& folder);

/// Where each was taken, and how far the vehicle had come. Beyond the truth's ends its first and last pose count.
void locate(std::vector<RecordedPanorama>& panoramas, const Trajectory& truth);

}  // namespace panvo::evaluation
