// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "panvo/evaluation/place_recording.hpp"

namespace panvo::evaluation {

/// Of OpenCV's spelling, too. Throws InputError where it cannot be read or understood.
YAML::Node read_yaml(const std::filesystem::path& file);

/// T_BS of an EuRoC/ASL sensor.yaml. Throws InputError.
Eigen::Isometry3d read_extrinsics(const std::filesystem::path& file);

/// What the panoramic camera's clock is ahead of the truth's, as a sequence.yaml says it; 0 where it does not. Throws InputError.
std::int64_t panorama_clock_offset_ns(const std::filesystem::path& file, const YAML::Node& sequence);

/// The images of a folder that are named by their stamp, in order; poses and way as yet unknown. Throws InputError for none.
std::vector<RecordedPanorama> list_panoramas(const std::filesystem::path& folder, std::int64_t clock_offset_ns);

/// Where each was taken, and how far the vehicle had come. Beyond the truth's ends its first and last pose count.
void locate(std::vector<RecordedPanorama>& panoramas, const Trajectory& truth);

}  // namespace panvo::evaluation
