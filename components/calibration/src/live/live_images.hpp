// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "panvo/calibration/board.hpp"
#include "panvo/calibration/view_choice.hpp"

namespace panvo::calibration {

/// Settings for collecting board images from live topics.
struct LiveImages {
  std::vector<std::string> topics;  ///< TOPIC or NAME:=TOPIC, one for each camera
  std::vector<std::string> names;   ///< camera names for topics without NAME; empty: the part before /image_raw
  std::filesystem::path out;        ///< images are written to OUT/NAME/STAMP.png
  ViewGoals goals;
  std::size_t max_views = 60;
  double limit_s = 300.0;     ///< total time
  double timeout_s = 5.0;     ///< for publishers, and for images
  double tolerance_ms = 5.0;  ///< largest stamp difference of simultaneous images
};

/// Collects images from the topics until the goals or limits are reached or Ctrl-C is pressed; reports progress on
/// stderr. Writes the images of the kept views in the layout of find_stereo_images() and find_rig_images(). Throws
/// CalibrationError for topics that are missing, silent or never simultaneous, for a folder that is not empty, or if no
/// board was seen.
void gather_images(const LiveImages& settings, const Board& board);

}  // namespace panvo::calibration
