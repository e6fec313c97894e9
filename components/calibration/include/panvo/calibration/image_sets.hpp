// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "panvo/calibration/board_detector.hpp"
#include "panvo/calibration/observations.hpp"

namespace panvo::calibration {

/// Images that several cameras took at once.
struct ImageSets {
  struct Set {
    std::string name;                          ///< of the files, without folder and ending
    std::vector<std::filesystem::path> files;  ///< by camera; empty: this one has none
  };

  std::vector<std::string> cameras;
  std::vector<Set> sets;  ///< ordered by name
};

/// Pairs in `folder`: files left*.png and right*.png (also jpg, bmp, pgm, tif; what follows left or right pairs them), or folders left/ and right/
/// or cam0/ and cam1/ with files of the same names, in mav0/ and data/ too. Throws CalibrationError when there are none.
ImageSets find_stereo_images(const std::filesystem::path& folder);

/// A folder for each camera, named as it; files of the same name were taken at once. `cameras`: which; empty: all folders that hold images.
ImageSets find_rig_images(const std::filesystem::path& folder, const std::vector<std::string>& cameras);

/// Looks for the board in all images. `progress` hears of each set. A file that cannot be read counts as not seen, with the reason. Throws
/// CalibrationError for a camera whose images differ in size.
Observations detect_boards(const ImageSets& images, const Board& board,
                           const std::function<void(std::size_t done, std::size_t of)>& progress);

}  // namespace panvo::calibration
