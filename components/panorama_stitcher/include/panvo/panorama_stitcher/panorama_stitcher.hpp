// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "panvo/panorama_stitcher/gain_compensator.hpp"
#include "panvo/panorama_stitcher/panorama_rig.hpp"
#include "panvo/panorama_stitcher/stitch_table.hpp"

namespace panvo::panorama_stitcher {

struct StitchSettings {
  int columns = 1080;  ///< of the panorama; half as many rows
  bool compensates_gains = false;
  GainSettings gains;
};

/// Makes one equirectangular panorama (vision::Equirectangular, [Lu2015 Eq. 10]) of the pictures of a rig's heads.
class PanoramaStitcher {
 public:
  /// Throws std::invalid_argument for a rig without heads or with more than 254, a size that is odd or not positive, and for directions
  /// that must be seen and that no head sees, saying how many and where.
  PanoramaStitcher(PanoramaRig rig, const StitchSettings& settings);

  /// Which heads to use from now on; the others see nothing, and what no other head sees is black. Makes a new table if it is another
  /// choice than before, which takes some tenths of a second.
  void use(const std::vector<bool>& heads);

  /// What keeps an image from being that of the rig, in words that follow its name; nullopt: nothing.
  std::optional<std::string> find_fault(std::size_t image, const cv::Mat& pixels) const;

  /// Stitches images of 8 bits and 1 or 3 channels, one for each image of the rig; those of heads that are not used may be empty.
  /// Writes into `panorama` (allocated when size or type differ). Throws std::invalid_argument where find_fault() finds one, and for
  /// images of different types.
  void stitch(std::span<const cv::Mat> images, cv::Mat& panorama);

  const PanoramaRig& rig() const { return rig_; }
  const StitchTable& table() const { return table_; }
  double gain(std::size_t head) const { return gains_.gain(head); }

 private:
  int check(std::span<const cv::Mat> images) const;
  void compensate(std::span<const cv::Mat> images);
  void patch(std::span<const cv::Mat> images, cv::Mat& panorama) const;

  PanoramaRig rig_;
  StitchSettings settings_;
  std::vector<bool> is_used_;
  StitchTable table_;
  GainCompensator gains_;
  std::vector<int> factors_;  ///< of each head's pixels, 256: as they are
};

}  // namespace panvo::panorama_stitcher
