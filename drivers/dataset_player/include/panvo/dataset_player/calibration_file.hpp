// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "panvo/calibration_files/stereo_pair.hpp"

/// Readers of stereo calibrations from common tools. All throw calibration_files::FileError.
namespace panvo::dataset_player {

using calibration_files::CalibratedStereo;

/// Image size, px, for calibrations that do not state one.
struct ImageSize {
  int width = 0, height = 0;
};

/// Reads BoofCV's StereoParameters (XML). Its rightToLeft maps points from the right to the left camera frame.
CalibratedStereo read_boofcv_calibration(const std::filesystem::path& file);

/// Reads a pair of ROS camera_info files as written by camera_calibration; keeps their R and P.
CalibratedStereo read_ros_calibration(const std::filesystem::path& left_file, const std::filesystem::path& right_file);

/// Reads an OpenCV stereo calibration: M1 D1 M2 D2 R T (or K1, cameraMatrix1, distCoeffs1 ...) in one file, or
/// intrinsics and extrinsics in two files as in OpenCV's stereo_calib sample. `image_size`: default if the file has
/// none.
CalibratedStereo read_opencv_calibration(const std::filesystem::path& intrinsics_file,
                                         const std::filesystem::path& extrinsics_file, ImageSize image_size);

/// The rectified pair of `calibration`; unchanged if it is already rectified. Throws FileError with `file` and every
/// problem of the calibration.
vision::RectifiedStereo rectified_geometry(const vision::StereoCalibration& calibration,
                                           const std::filesystem::path& file);

}  // namespace panvo::dataset_player
