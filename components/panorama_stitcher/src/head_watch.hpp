// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "panvo/panorama_stitcher/panorama_rig.hpp"

namespace panvo::panorama_stitcher {

/// Monitors each head of a rig: seen, missing, or dark in several consecutive images.
class HeadWatch {
 public:
  HeadWatch(const PanoramaRig& rig, int dark_after) : rig_(rig), dark_after_(dark_after), heads_(rig.heads.size()) {}

  /// Checks the images of a set; an empty image means that the camera is missing. Returns whether the usability of a
  /// head changed.
  bool look(const std::vector<cv::Mat>& images);

  /// Whether each head can be used for the panorama.
  std::vector<bool> usable() const;

  /// "seen", "missing" or "dark, is black ..."
  const std::string& state(std::size_t head) const { return heads_.at(head).state; }
  bool is_usable(std::size_t head) const { return heads_.at(head).is_usable; }

 private:
  struct State {
    std::string state = "seen";
    bool is_usable = true;
    int dark = 0;  ///< consecutive dark images
  };

  const PanoramaRig& rig_;
  int dark_after_;
  std::vector<State> heads_;
};

}  // namespace panvo::panorama_stitcher
