// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "panvo/evaluation/place_method.hpp"
#include "panvo/places/panorama_image.hpp"
#include "panvo/places/place_finder.hpp"

namespace panvo::evaluation {

/// A panorama of a plain folder, with what is known of its place.
struct FolderPanorama {
  std::string name;
  places::PanoramaImage image;
  std::string place;  ///< label; empty: none, the pose decides
  std::optional<Eigen::Isometry3d> world_from_base;
  std::optional<double> heading_rad;  ///< left positive, of the label file or the pose
};

/// Reads a folder of images with poses (see places::read_image_folder), or with labels in places.csv: lines
/// image,place[,heading_deg]. An image with an empty place is of a place that no other shows. Images that cannot be used are
/// passed to `report` with the reason and left out. Throws InputError or places::FolderError.
std::vector<FolderPanorama> read_folder_panoramas(const std::filesystem::path& folder,
                                                  const std::filesystem::path& poses,
                                                  const std::optional<places::ElevationRange>& range,
                                                  const std::function<void(const std::string&)>& report);

/// What is asked: the library, and panoramas to recognise or not.
struct FolderTask {
  std::vector<const FolderPanorama*> library, queries;
  double same_place_m = 15.0;

  bool is_same(const FolderPanorama& a, const FolderPanorama& b) const;
  bool is_known(const FolderPanorama& query) const;
};

/// With `earlier`, its panoramas are the library and those of `folder` the queries. Without, the first panorama of each
/// place is the library, and the others are queries. With poses, a panorama is not a query until the path since its place was
/// added is longer than twice `same_place_m`: before that, the camera has not left the place.
FolderTask folder_task(const std::vector<FolderPanorama>& folder, const std::vector<FolderPanorama>* earlier,
                       double same_place_m);

/// How a method answered. A query of an unknown place has no right answer.
struct FolderScore {
  std::string method;
  int known = 0, unknown = 0;       ///< queries
  int right_first = 0;              ///< known queries whose most similar place is right
  int right_at_full_precision = 0;  ///< of these, more similar than every wrong answer to any query
  bool answers_unknown = false;     ///< the method itself decides; then the next two count, else they are 0
  int right = 0, wrong = 0;
  std::vector<double> heading_errors_rad;  ///< absolute, of right first answers with a known heading; sorted
};

FolderScore score_folder(const PlaceMethod& method, const FolderTask& task);
/// By bearings and geometry, as `panvo places match`. Its distance is the expectation by chance.
FolderScore score_folder(const places::PlaceFinderParameters& parameters, const FolderTask& task);

std::string folder_table(const std::vector<FolderScore>& scores);

}  // namespace panvo::evaluation
