// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <vector>

/// An EuRoC/ASL data set as far as junctions need it: cam2, ground truth, and what sequence.yaml lists.
namespace panvo::landmark_builder {

struct RecordedPanorama {
  std::int64_t stamp_ns = 0;
  std::filesystem::path image;
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();  ///< true, interpolated
};

struct ListedJunction {
  int id = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< map, m
  int degree = 0;                                      ///< roads that meet there
};

struct Recording {
  Eigen::Isometry3d base_from_panorama = Eigen::Isometry3d::Identity();
  std::vector<RecordedPanorama> panoramas;  ///< stamps increase; those that the ground truth covers
  std::vector<ListedJunction> junctions;    ///< empty where there is no sequence.yaml
};

/// Throws std::runtime_error naming the file and what is wrong with it.
Recording read_recording(const std::filesystem::path& directory);

}  // namespace panvo::landmark_builder
