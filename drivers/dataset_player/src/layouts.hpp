// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "panvo/calibration_files/yaml_map.hpp"
#include "panvo/dataset_player/calibration_file.hpp"
#include "panvo/dataset_player/dataset.hpp"

/// The layouts supported by open_dataset(), each with a detection and a reader.
namespace panvo::dataset_player {

/// Kind of a sensor.yaml, for messages.
inline constexpr const char* kSensorFile = "a sensor.yaml of a data set in EuRoC/ASL layout";

/// Calls `read`; the FileError of a calibration file becomes the DatasetError that callers expect.
template <class Read>
auto with_dataset_error(Read read) {
  try {
    return read();
  } catch (const calibration_files::FileError& error) {
    throw DatasetError(error.what());
  }
}

/// KITTI odometry: calib.txt with image_0 and image_1 (grey) or image_2 and image_3 (colour).
bool looks_like_kitti(const std::filesystem::path& directory);
Dataset read_kitti(const std::filesystem::path& directory, const ReadOptions& options);
std::optional<std::filesystem::path> find_kitti_ground_truth(const std::filesystem::path& directory);

/// EuRoC/ASL: mav0 with cam0, cam1, cam2 and ground truth.
bool looks_like_euroc(const std::filesystem::path& directory);
Dataset read_euroc(const std::filesystem::path& directory, const ReadOptions& options);
std::optional<std::filesystem::path> find_euroc_ground_truth(const std::filesystem::path& directory);
/// mav0, or `directory` if that is mav0 itself.
std::filesystem::path euroc_root(const std::filesystem::path& directory);
/// Reads T_BS of a sensor.yaml: pose of the sensor in base_link (EuRoC's body frame B).
Eigen::Isometry3d read_base_from_sensor(calibration_files::YamlMap& sensor);

/// The inertial measurements in mav0/imu0; nullopt if there are none.
std::optional<ImuRecording> read_euroc_imu(const std::filesystem::path& folder);

/// Folders left and right with a calibration file.
bool looks_like_folders(const std::filesystem::path& directory);
Dataset read_folders(const std::filesystem::path& directory, const ReadOptions& options);

// Shared by the readers.

/// Rotation from an optical frame to vehicle axes: x forward, y left, z up.
Eigen::Isometry3d base_from_optical();

/// Size of the first pair that can be decoded. Throws DatasetError if the two images differ in size or none of the
/// first ten pairs can be decoded.
ImageSize stereo_image_size(const std::vector<StereoFrame>& frames);

/// Throws DatasetError unless the images have the size stated in `calibration_file`.
void expect_image_size(const vision::PinholeCamera& camera, const std::filesystem::path& calibration_file,
                       const std::vector<StereoFrame>& frames);

/// The stamp of the image `place` of a recording without times. Throws DatasetError, naming the image, if messages cannot
/// hold it.
std::int64_t stamp_at(std::uint64_t place, double rate_hz, const std::filesystem::path& image);

/// Two images with the same number in their names.
struct NumberedPair {
  std::size_t place =
      0;  ///< index among the frames of both folders, so that a gap in one folder does not shift later frames
  std::uint64_t number = 0;
  std::filesystem::path left, right;
};
struct PairedFolders {
  std::vector<NumberedPair> pairs;
  std::size_t places = 0;
};
/// Pairs the images of two folders; reports unpaired ones in `notes`. Throws DatasetError if a folder is missing or
/// there are no pairs.
PairedFolders pair_by_number(const std::filesystem::path& left_folder, const std::filesystem::path& right_folder,
                             std::vector<std::string>& notes);

}  // namespace panvo::dataset_player
