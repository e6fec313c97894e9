// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "panvo/dataset_player/calibration_file.hpp"
#include "panvo/dataset_player/dataset.hpp"

/// The layouts that open_dataset() knows. Each has a look at a folder, and reads it.
namespace panvo::dataset_player {

/// KITTI odometry: calib.txt beside image_0 and image_1 (grey) or image_2 and image_3 (colour).
bool looks_like_kitti(const std::filesystem::path& directory);
Dataset read_kitti(const std::filesystem::path& directory, const ReadOptions& options);

/// EuRoC/ASL: mav0 with cam0, cam1, cam2 and ground truth.
bool looks_like_euroc(const std::filesystem::path& directory);
Dataset read_euroc(const std::filesystem::path& directory, const ReadOptions& options);

/// The folders left and right beside a calibration file.
bool looks_like_folders(const std::filesystem::path& directory);
Dataset read_folders(const std::filesystem::path& directory, const ReadOptions& options);

// Shared by the readers:

/// base_link at an optical frame with the axes of a vehicle: x forward, y left, z up.
Eigen::Isometry3d base_from_optical();

/// Size of the first pair that can be decoded. Throws DatasetError when the two differ or none of the first few can.
ImageSize stereo_image_size(const std::vector<StereoFrame>& frames);

/// Throws DatasetError unless the images are of the size that `calibration_file` states.
void expect_image_size(const vision::PinholeCamera& camera, const std::filesystem::path& calibration_file,
                       const std::vector<StereoFrame>& frames);

/// Two images of the same number in their names.
struct NumberedPair {
  std::size_t place =
      0;  ///< among the frames that either folder has, so that a gap in one keeps the time of the others
  std::uint64_t number = 0;
  std::filesystem::path left, right;
};
struct PairedFolders {
  std::vector<NumberedPair> pairs;
  std::size_t places = 0;
};
/// Says in `notes` how many images stay without a partner. Throws DatasetError when a folder is missing or no pair is
/// left.
PairedFolders pair_by_number(const std::filesystem::path& left_folder, const std::filesystem::path& right_folder,
                             std::vector<std::string>& notes);

}  // namespace panvo::dataset_player
