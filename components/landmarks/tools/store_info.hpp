// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "panvo/landmarks/landmark_store.hpp"

namespace panvo::landmarks {

/// Two landmarks closer to each other than places should be.
struct ClosePair {
  std::uint32_t first, second;
  double distance_m;
};

/// Report of `panvo landmarks info` on a store.
struct StoreInfo {
  std::string file;
  std::size_t landmarks = 0, junctions = 0;
  std::uint64_t keypoints = 0, features_large = 0, features_small = 0;
  StoredBytes bytes;                                                                      ///< all landmarks together
  Eigen::Vector2d smallest = Eigen::Vector2d::Zero(), largest = Eigen::Vector2d::Zero();  ///< corners in the map, m
  std::int64_t first_stamp_ns = 0, last_stamp_ns = 0;
  std::uint64_t passes = 0, recognitions = 0;  ///< of all landmarks together
  std::size_t missed = 0;                      ///< landmarks that were not recognised on their last pass
  DescriptionSettings settings;
  std::vector<ClosePair> close;       ///< in order of ids
  std::optional<std::string> damage;  ///< if damage was looked for
};

/// `look_for_damage`: reads the whole file.
StoreInfo inspect(const LandmarkStore& store, double close_m, bool look_for_damage);

std::string describe_as_text(const StoreInfo& info);
std::string describe_as_json(const StoreInfo& info);

}  // namespace panvo::landmarks
