// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "live/live_images.hpp"

namespace panvo::calibration {

/// What the command line says; each command uses its part. All throw CalibrationError.
struct Arguments {
  std::filesystem::path images;  ///< or the file to convert; empty: taken from `live`
  LiveImages live;
  std::string board;
  std::string model = "plumb_bob";
  std::filesystem::path out;
  std::filesystem::path calibration;  ///< folder of camera_info files: to begin with, to hold, or to check
  std::vector<std::string> cameras;
  std::string reference;
  std::vector<double> mount = std::vector<double>(6, 0.0);
  double limit_px = 0.5;
};

/// left.yaml, right.yaml and the report of a pair.
void calibrate_stereo(const Arguments& arguments);

/// Lenses and poses of a rig: NAME.yaml, extrinsics.yaml, panorama.yaml where the heads see all round, and the report.
void calibrate_rig(const Arguments& arguments);

/// Poses of cameras whose lenses are calibrated: extrinsics.yaml and the report.
void calibrate_extrinsics(const Arguments& arguments);

/// Whether rows still agree in a calibrated pair; false: they do not, and it says so.
bool check_stereo(const Arguments& arguments);

/// Kalibr's camchain to camera_info files, or a folder of those to a camchain.
void convert(const Arguments& arguments);

/// The board as SVG.
void draw(const Arguments& arguments);

}  // namespace panvo::calibration
