// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "panvo/calibration/board_detector.hpp"
#include "panvo/calibration/observations.hpp"

namespace panvo::calibration {

/// Sets of simultaneous images of several cameras.
struct ImageSets {
  struct Set {
    std::string name;                          ///< of the files, without folder and extension
    std::vector<std::filesystem::path> files;  ///< by camera; empty path: no image
  };

  std::vector<std::string> cameras;
  std::vector<Set> sets;  ///< ordered by name
};

/// Finds pairs in `folder`: files left*.png and right*.png (also jpg, bmp, pgm, tif) with equal names after left or
/// right, or folders left/ and right/ or cam0/ and cam1/ with equal file names, also in mav0/ and data/. Throws
/// CalibrationError if there are none.
ImageSets find_stereo_images(const std::filesystem::path& folder);

/// Finds the images of a rig: a folder for each camera, named after it; files with equal names form a set. `cameras`:
/// the folders to use; empty: all that contain images. Throws CalibrationError.
ImageSets find_rig_images(const std::filesystem::path& folder, const std::vector<std::string>& cameras);

/// Detects the board in all images. `progress` is called after each set. An unreadable file counts as not seen, with
/// the reason. Throws CalibrationError if images of a camera differ in size or none is readable.
Observations detect_boards(const ImageSets& images, const Board& board,
                           const std::function<void(std::size_t done, std::size_t of)>& progress);

}  // namespace panvo::calibration
