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
  int columns = 1080;  ///< width of the panorama, px; the height is half
  bool compensates_gains = false;
  GainSettings gains;
};

/// Stitches the images of a rig's heads into an equirectangular panorama (vision::Equirectangular, [Lu2015 Eq. 10]).
class PanoramaStitcher {
 public:
  /// Throws std::invalid_argument for a rig without heads or with more than 254, for an odd or non-positive width, and
  /// for required directions that no head sees, with their share and an example.
  PanoramaStitcher(PanoramaRig rig, const StitchSettings& settings);

  /// Selects the heads to use, one flag for each; directions that only other heads see become black. A changed
  /// selection recomputes the table, which takes a few tenths of a second.
  void use(const std::vector<bool>& heads);

  /// Describes why an image does not match the rig, as text to follow its name; nullopt if it matches.
  std::optional<std::string> find_fault(std::size_t image, const cv::Mat& pixels) const;

  /// Stitches 8-bit images with 1 or 3 channels, one for each image of the rig; images of unused heads may be empty.
  /// Writes to `panorama` (reallocated if size or type differ). Throws std::invalid_argument if find_fault() reports a
  /// fault or the images differ in type.
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
  std::vector<int> factors_;  ///< brightness factor of each head; 256: unchanged
};

}  // namespace panvo::panorama_stitcher
