// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <vector>

/// The parts of an EuRoC/ASL data set needed for junctions: cam2, ground truth, and the list in sequence.yaml.
namespace panvo::landmark_builder {

struct RecordedPanorama {
  std::int64_t stamp_ns = 0;
  std::filesystem::path image;
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();  ///< ground truth, interpolated
};

struct ListedJunction {
  int id = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< map, m
  int degree = 0;                                      ///< roads that meet there
};

struct Recording {
  Eigen::Isometry3d base_from_panorama = Eigen::Isometry3d::Identity();
  std::vector<RecordedPanorama> panoramas;  ///< in order of stamps; only those covered by the ground truth
  std::vector<ListedJunction> junctions;    ///< empty if there is no sequence.yaml
};

/// Throws std::runtime_error naming the file and the problem.
Recording read_recording(const std::filesystem::path& directory);

}  // namespace panvo::landmark_builder
