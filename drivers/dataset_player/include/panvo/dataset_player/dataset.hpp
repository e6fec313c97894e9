// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "panvo/vision/stereo_calibration.hpp"

/// Description of recorded data sets of any layout: images, capture times and cameras.
namespace panvo::dataset_player {

/// Two simultaneous images. If a data set has no capture times, stamps are derived from the frame rate.
struct StereoFrame {
  std::int64_t stamp_ns = 0;
  std::filesystem::path left, right;
};

/// The stereo camera and its recording. `base_from_left` places the raw left optical frame on the vehicle (base_link: x
/// forward, y left, z up).
struct StereoRecording {
  vision::StereoCalibration calibration;  ///< the images as they are stored
  vision::RectifiedStereo
      rectified;  ///< the target of the rectification; its rotations are identity for rectified images
  Eigen::Isometry3d base_from_left = Eigen::Isometry3d::Identity();
  std::vector<StereoFrame> frames;  ///< stamps increase

  Eigen::Isometry3d base_from_right() const { return base_from_left * calibration.right_from_left.inverse(); }
};

struct PanoramaFrame {
  std::int64_t stamp_ns = 0;
  std::filesystem::path image;
};

/// The equirectangular panorama and its recording.
struct PanoramaRecording {
  int width = 0, height = 0;  ///< px
  Eigen::Isometry3d base_from_panorama = Eigen::Isometry3d::Identity();
  std::vector<PanoramaFrame> frames;  ///< stamps increase
};

/// An inertial measurement in the axes of the IMU.
struct ImuSample {
  std::int64_t stamp_ns = 0;
  Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_m_s2 = Eigen::Vector3d::Zero();
};

struct ImuRecording {
  Eigen::Isometry3d base_from_imu = Eigen::Isometry3d::Identity();
  double rate_variance = 0.0, acceleration_variance = 0.0;  ///< of a sample's noise; 0: not stated
  std::vector<ImuSample> samples;                           ///< stamps increase
};

struct GroundTruthPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
};

struct Dataset {
  std::string kind;  ///< "KITTI odometry", "EuRoC/ASL", "left/right folders"
  std::filesystem::path directory;
  std::optional<StereoRecording> stereo;
  std::optional<PanoramaRecording> panorama;
  std::optional<ImuRecording> imu;
  std::vector<GroundTruthPose> ground_truth;  ///< stamps increase; may be empty
  std::vector<std::string> notes;             ///< warnings for the user: skipped frames, assumed frame rate
};

/// An unusable data set. what() gives the file, the line if any, and the remedy.
class DatasetError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ReadOptions {
  /// Frame rate of data sets without capture times; 0: default of the layout (KITTI 10, folders 30).
  double rate_hz = 0.0;
  /// Calibration folder for left/right folders; empty: the data set's own.
  std::filesystem::path calibration = {};
};

/// Reads the description of the data set in `directory`; detects the layout. Validates everything except the pixels of
/// images after the first. Throws DatasetError.
Dataset open_dataset(const std::filesystem::path& directory, const ReadOptions& options = {});

/// Reads only the panorama of the EuRoC/ASL data set in `directory`: cam2, if it is equirectangular, else nullopt. Appends
/// warnings for the user to `notes`. Throws DatasetError.
std::optional<PanoramaRecording> open_panorama(const std::filesystem::path& directory, std::vector<std::string>& notes);

}  // namespace panvo::dataset_player
