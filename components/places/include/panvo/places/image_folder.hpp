// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace panvo::places {

/// The user's input cannot be used. The message names the file, the problem and the remedy.
class FolderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An image of a folder.
struct FolderImage {
  std::filesystem::path file;
  std::optional<Eigen::Isometry3d> map_from_base;
  std::optional<double> time_s;
};

/// The images of a folder, or of the list of one image, in order of the numbers in their names. Poses and times come from
/// `poses`: lines `image,x_m,y_m,heading_deg` (names, any order), or TUM (`t x y z qx qy qz qw`) or KITTI (12 numbers, optical
/// axes), one per image in order; the first line may name the columns. Empty: poses.csv or poses.txt in the folder, if
/// there. Throws FolderError.
std::vector<FolderImage> read_image_folder(const std::filesystem::path& folder, const std::filesystem::path& poses);

}  // namespace panvo::places
