// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "panvo/panorama_stitcher/panorama_rig.hpp"

namespace panvo::panorama_stitcher {

/// How each head of a rig is: seen, missing, or dark for several images in a row.
class HeadWatch {
 public:
  HeadWatch(const PanoramaRig& rig, int dark_after) : rig_(rig), dark_after_(dark_after), heads_(rig.heads.size()) {}

  /// Looks at the images of a set; empty ones are of cameras that are missing. Returns whether a head's state changed.
  bool look(const std::vector<cv::Mat>& images);

  /// Whether the panorama may show it.
  std::vector<bool> usable() const;

  /// "seen", "missing", "dark: is black: ..."
  const std::string& state(std::size_t head) const { return heads_.at(head).state; }
  bool is_usable(std::size_t head) const { return heads_.at(head).is_usable; }

 private:
  struct State {
    std::string state = "seen";
    bool is_usable = true;
    int dark = 0;  ///< images in a row
  };

  const PanoramaRig& rig_;
  int dark_after_;
  std::vector<State> heads_;
};

}  // namespace panvo::panorama_stitcher
