// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>

namespace panvo::vision {

/// Learns which part of a panorama shows the vehicle itself, such as a mast, a frame or a load: what stays where it is in
/// the picture while the vehicle turns.
class VehicleMask {
 public:
  static constexpr int kColumns = 108, kRows = 54;  ///< cells of 3.3 degrees

  /// Whether the vehicle has turned enough since the panorama that was added last, or that one is too old. `yaw_rad`: by
  /// odometry.
  bool wants(std::int64_t stamp_ns, double yaw_rad) const;

  /// Compares a panorama (CV_8UC1 or CV_8UC3, equirectangular, 2:1) with the one that was added last, if that is not too
  /// old. Returns whether seen() has changed. If most of the band stays, the vehicle has hardly turned, whatever
  /// odometry says: nothing is learned from the pair.
  bool add(std::int64_t stamp_ns, const cv::Mat& panorama, double yaw_rad);

  /// CV_8UC1, kRows x kColumns: 0 where the vehicle covers the view, else 255.
  const cv::Mat& seen() const noexcept { return seen_; }

 private:
  bool is_too_old_at(std::int64_t stamp_ns) const;
  void judge(const cv::Mat& likeness);

  cv::Mat edges_;  // of the panorama that was added last, CV_32FC1; empty: none was
  std::int64_t stamp_ns_ = 0;
  double yaw_rad_ = 0.0;
  std::size_t steps_ = 0;
  cv::Mat stays_{kRows, kColumns, CV_8UC1, cv::Scalar(0)};  // points for turns in which a cell stayed
  cv::Mat seen_{kRows, kColumns, CV_8UC1, cv::Scalar(255)};
};

/// The cells of a mask given as a picture of the whole panorama (CV_8UC1): 0 where it is not all white, else 255.
cv::Mat to_cells(const cv::Mat& picture);

}  // namespace panvo::vision
