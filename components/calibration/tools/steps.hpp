// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "commands.hpp"
#include "panvo/calibration/camera_info_file.hpp"
#include "panvo/calibration/image_sets.hpp"
#include "panvo/calibration/report.hpp"
#include "panvo/calibration/rig_file.hpp"

/// What several commands do.
namespace panvo::calibration {

/// The lens model of --model. Mei's and the others' names are ROS's.
vision::LensModel model_of(const Arguments& arguments);

/// The folder of images: the one that was named, or OUT/images with pictures taken now from live topics.
std::filesystem::path images_of(const Arguments& arguments, const Board& board, const ViewGoals& goals,
                                const std::vector<std::string>& names = {});

/// Looks for the board, saying on stderr how far it is.
Observations detect(const ImageSets& images, const Board& board);

/// Camera_info of each camera, FOLDER/NAME.yaml, of the size of its images.
std::vector<CameraInfo> read_calibrations(const std::filesystem::path& folder, const Observations& observations);

/// Makes the folder of --out.
void make_folder(const std::filesystem::path& folder);

std::vector<NamedCamera> named_cameras(const RigCalibration& calibration);

/// report.html, coverage_NAME.svg and residuals_NAME.svg, and the text on stdout.
void write_report(const Report& report, const std::filesystem::path& folder);

}  // namespace panvo::calibration
