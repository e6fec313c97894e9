// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "panvo/landmarks/keypoints.hpp"
#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/places/panorama_image.hpp"

namespace panvo::places {

/// A panorama as it is recognised later: of one position, without metres.
struct KnownPlace {
  std::string name;  ///< of the image file
  std::optional<Eigen::Isometry3d> map_from_base;
  landmarks::PanoramaDescription description;
  std::vector<landmarks::Keypoint> keypoints;
  std::vector<std::uint8_t> thumbnail;  ///< JPEG, 540x270
};

/// SIFT features for recognition by bearings alone: more than for a metric landmark, at full size, over more elevations.
landmarks::KeypointParameters place_keypoints();

/// Describer with fixed parameters, shared by all libraries. Its features only rank candidates, so they need no tuning.
const landmarks::PanoramaDescriber& place_describer();

KnownPlace make_place(const std::string& name, const PanoramaImage& image);

/// Writes a landmark store (`panvo landmarks info` and `show` read it) with the names of the places. Replaces the file when
/// it is complete. Throws landmarks::StoreError.
void save_places(const std::filesystem::path& file, const std::vector<KnownPlace>& places);

/// Throws landmarks::StoreError, also for a store that was not made by save_places().
std::vector<KnownPlace> load_places(const std::filesystem::path& file);

}  // namespace panvo::places
