// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <filesystem>
#include <vector>

#include "panvo/dataset_player/dataset.hpp"
#include "panvo/evaluation/journey_recording.hpp"

namespace panvo::evaluation {

/// Also accepts OpenCV's header `%YAML:1.0`. Throws InputError if the file cannot be read or parsed.
YAML::Node read_yaml(const std::filesystem::path& file);

/// Clock of the panoramic camera minus clock of the ground truth, from sequence.yaml; 0 if not given. Throws
/// InputError.
std::int64_t panorama_clock_offset_ns(const std::filesystem::path& file, const YAML::Node& sequence);

/// Lists the panoramas in order of time, without poses, for a camera whose clock is ahead by `clock_offset_ns`.
std::vector<RecordedPanorama> list_panoramas(const dataset_player::PanoramaRecording& recorded,
                                             std::int64_t clock_offset_ns);

/// Sets pose and distance travelled of each panorama. Outside the time span of the ground truth, its first or last pose
/// is used.
void locate(std::vector<RecordedPanorama>& panoramas, const Trajectory& truth);

}  // namespace panvo::evaluation
