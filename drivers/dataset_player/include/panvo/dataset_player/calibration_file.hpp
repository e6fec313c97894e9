// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "panvo/vision/stereo_calibration.hpp"

/// Stereo calibrations as the tools that people use write them. All throw DatasetError, naming file, line and key.
namespace panvo::dataset_player {

struct CalibratedStereo {
  vision::StereoCalibration calibration;
  vision::RectifiedStereo rectified;
};

/// Image size of cameras whose calibration does not state one; px.
struct ImageSize {
  int width = 0, height = 0;
};

/// BoofCV's StereoParameters as XML. Its rightToLeft takes points of the right camera to the left one.
CalibratedStereo read_boofcv_calibration(const std::filesystem::path& file);

/// A pair of ROS camera_info files as camera_calibration writes them; its R and P are kept as they are.
CalibratedStereo read_ros_calibration(const std::filesystem::path& left_file, const std::filesystem::path& right_file);

/// OpenCV stereo calibration: M1 D1 M2 D2 R T (also spelt K1, cameraMatrix1, distCoeffs1 ...) in one file, or
/// intrinsics and extrinsics in two as OpenCV's stereo_calib sample leaves them. `image_size` is used where the file
/// has none.
CalibratedStereo read_opencv_calibration(const std::filesystem::path& intrinsics_file,
                                         const std::filesystem::path& extrinsics_file, ImageSize image_size);

/// The pair that `calibration` rectifies to: itself when it is rectified already. Throws DatasetError naming `file`
/// and every problem of the calibration.
vision::RectifiedStereo rectified_geometry(const vision::StereoCalibration& calibration,
                                           const std::filesystem::path& file);

}  // namespace panvo::dataset_player
