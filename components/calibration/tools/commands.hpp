// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "live/live_images.hpp"

namespace panvo::calibration {

/// Parsed command line; each command uses a part of it. All commands throw CalibrationError or
/// calibration_files::FileError.
struct Arguments {
  std::filesystem::path images;  ///< image folder, or the file to convert; empty: use `live`
  LiveImages live;
  std::string board;
  std::string model = "plumb_bob";
  std::filesystem::path out;
  std::filesystem::path calibration;  ///< folder of camera_info files: initial values, fixed lenses, or to be checked
  std::vector<std::string> cameras;
  std::string reference;
  std::vector<double> mount = std::vector<double>(6, 0.0);
  double limit_px = 0.5;
};

/// Calibrates a pair: left.yaml, right.yaml and the report.
void calibrate_stereo(const Arguments& arguments);

/// Calibrates lenses and poses of a rig: NAME.yaml, extrinsics.yaml, panorama.yaml if the cameras cover the full
/// horizon, and the report.
void calibrate_rig(const Arguments& arguments);

/// Estimates the poses of cameras with calibrated lenses: extrinsics.yaml and the report.
void calibrate_extrinsics(const Arguments& arguments);

/// Checks the row alignment of a calibrated pair and prints the result. Returns false if the calibration is stale.
bool check_stereo(const Arguments& arguments);

/// Converts a Kalibr camchain to camera_info files, or a folder of these to a camchain.
void convert(const Arguments& arguments);

/// Writes the board as SVG.
void draw(const Arguments& arguments);

}  // namespace panvo::calibration
