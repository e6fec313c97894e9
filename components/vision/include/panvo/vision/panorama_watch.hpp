// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "panvo/vision/repeated_image.hpp"

namespace panvo::vision {

/// Tells a panorama that its camera cannot have taken as it took those before: one that is the last again, and one that is upside down or
/// mirrored against it. Between two panoramas in a row a vehicle does neither. What shows nothing is for others to find.
class PanoramaWatch {
 public:
  /// Why a panorama (CV_8UC1 or CV_8UC3, equirectangular) is not like those before; nullopt when it is. Every panorama of one camera is to pass, in
  /// order. A camera that stays upside down is said to be so until it is turned back.
  std::optional<std::string> find_fault(const cv::Mat& panorama);

 private:
  static constexpr int kColumns = 72, kRows = 36;
  using Thumbnail = Eigen::Matrix<float, kRows, kColumns, Eigen::RowMajor>;
  struct View {
    Thumbnail grey;       ///< of mean 0 and norm 1
    Thumbnail structure;  ///< the same without what all columns have in common: sky above, ground below
  };

  static std::optional<View> view_of(const cv::Mat& panorama);
  static double likeness(const Thumbnail& before, const Thumbnail& now, double enough = 1.0);
  void compare(const View& before, View now);

  RepeatedImage image_;
  std::optional<View> before_;
  bool is_mirrored_ = false, is_upended_ = false;  // the last one, against the first
};

}  // namespace panvo::vision
