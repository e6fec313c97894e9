// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "panvo/localizer/local_pose_graph.hpp"
#include "panvo/vision/geodesy.hpp"

namespace panvo::localizer {

/// Where on earth a map is.
struct Georeference {
  std::string map_frame;
  vision::GeoPoint origin;  ///< of the frame east, north, up
  PoseInMap map_from_enu;
};

/// As write_kept() and read_kept().
void write_georeference(const std::filesystem::path& file, const Georeference& georeference);
std::optional<Georeference> read_georeference(const std::filesystem::path& file);

}  // namespace panvo::localizer
