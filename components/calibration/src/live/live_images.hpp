// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "panvo/calibration/board.hpp"
#include "panvo/calibration/view_choice.hpp"

namespace panvo::calibration {

/// Pictures of a board to be taken from live topics.
struct LiveImages {
  std::vector<std::string> topics;  ///< TOPIC or NAME:=TOPIC, one a camera
  std::vector<std::string> names;   ///< of the cameras whose topics have none; empty: what stands before /image_raw
  std::filesystem::path out;        ///< pictures go to OUT/NAME/STAMP.png
  ViewGoals goals;
  std::size_t most_views = 60;
  double limit_s = 300.0;     ///< of all
  double timeout_s = 5.0;     ///< of waiting for publishers, and for images
  double tolerance_ms = 5.0;  ///< between stamps of images taken at once
};

/// Watches the topics until the board was seen enough, the limits are reached or Ctrl-C comes, and says on stderr how far it is. Leaves
/// the pictures of the views that are kept, those taken at once under one name, as find_stereo_images and find_rig_images take them. Throws
/// CalibrationError: topics that are not there, send nothing or never at once; a folder that is not empty; no board.
void gather_images(const LiveImages& settings, const Board& board);

}  // namespace panvo::calibration
