// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "commands.hpp"
#include "panvo/calibration/image_sets.hpp"
#include "panvo/calibration/report.hpp"
#include "panvo/calibration/rig_file.hpp"
#include "panvo/calibration_files/camera_info.hpp"

/// Steps shared by several commands.
namespace panvo::calibration {

/// The lens model of --model, a name known to vision::find_lens_model().
vision::LensModel model_of(const Arguments& arguments);

/// The image folder: that of the command line, or OUT/images after collecting images from live topics.
std::filesystem::path images_of(const Arguments& arguments, const Board& board, const ViewGoals& goals,
                                const std::vector<std::string>& names = {});

/// Detects the board; reports progress on stderr.
Observations detect(const ImageSets& images, const Board& board);

/// Reads FOLDER/NAME.yaml of each camera. Throws CalibrationError if its size differs from that of the images.
std::vector<calibration_files::CameraInfo> read_calibrations(const std::filesystem::path& folder,
                                                             const Observations& observations);

/// Creates the folder of --out.
void make_folder(const std::filesystem::path& folder);

std::vector<NamedCamera> named_cameras(const RigCalibration& calibration);

/// Writes report.html, coverage_NAME.svg and residuals_NAME.svg, and prints the text report.
void write_report(const Report& report, const std::filesystem::path& folder);

}  // namespace panvo::calibration
