// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "panvo/vision/repeated_image.hpp"

namespace panvo::vision {

/// Detects panoramas that are identical to the previous one (frozen camera), or upside down or mirrored relative to it.
/// Does not detect images without content.
class PanoramaWatch {
 public:
  /// Adds the next panorama of a camera (CV_8UC1 or CV_8UC3, equirectangular); returns its fault, nullopt if there is
  /// none. A camera that stays upside down is reported until it is turned back.
  std::optional<std::string> add(const cv::Mat& panorama);

 private:
  static constexpr int kColumns = 72, kRows = 36;
  using Thumbnail = Eigen::Matrix<float, kRows, kColumns, Eigen::RowMajor>;
  struct View {
    Thumbnail grey;       ///< mean 0, norm 1
    Thumbnail structure;  ///< `grey` less the mean of each row (sky, ground); norm 1
  };

  static std::optional<View> view_of(const cv::Mat& panorama);
  static double likeness(const Thumbnail& before, const Thumbnail& now, double enough = 1.0);
  void note_flips(const View& before, View now);

  RepeatedImage image_;
  std::optional<View> before_;
  bool is_mirrored_ = false, is_upended_ = false;  // latest panorama relative to the first
};

}  // namespace panvo::vision
