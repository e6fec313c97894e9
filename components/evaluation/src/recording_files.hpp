// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "panvo/evaluation/place_recording.hpp"

namespace panvo::evaluation {

/// Also accepts OpenCV's header `%YAML:1.0`. Throws InputError if the file cannot be read or parsed.
YAML::Node read_yaml(const std::filesystem::path& file);

/// T_BS of an EuRoC/ASL sensor.yaml. Throws InputError.
Eigen::Isometry3d read_extrinsics(const std::filesystem::path& file);

/// Clock of the panoramic camera minus clock of the ground truth, from sequence.yaml; 0 if not given. Throws
/// InputError.
std::int64_t panorama_clock_offset_ns(const std::filesystem::path& file, const YAML::Node& sequence);

/// Lists the images of a folder that are named by their stamp, in order of time, without poses. Throws InputError if
/// there are none.
std::vector<RecordedPanorama> list_panoramas(const std::filesystem::path& folder, std::int64_t clock_offset_ns);

/// Sets pose and distance travelled of each panorama. Outside the time span of the ground truth, its first or last pose
/// is used.
void locate(std::vector<RecordedPanorama>& panoramas, const Trajectory& truth);

}  // namespace panvo::evaluation
