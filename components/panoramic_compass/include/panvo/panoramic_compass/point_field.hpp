// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

#include "panvo/panoramic_compass/compass_parameters.hpp"
#include "panvo/vision/image_pyramid.hpp"
#include "panvo/vision/patch_template.hpp"

namespace panvo::panoramic_compass {

/// A band of a panorama with wrap-around margins at both ends, at full and half size.
struct RoundBand {
  static constexpr int kMargin_px = 64;

  int columns = 0;  ///< of the full turn, without margins
  vision::ImagePyramid pyramid;
  double sky_grey = 256.0;  ///< sky is not darker than this; 256: unknown

  RoundBand() = default;
  /// `band`: CV_8UC1, a full turn.
  explicit RoundBand(const cv::Mat& band, double darkest_sky = 256.0);
};

/// A point of the reference panorama, found in another one; px in the band, u in [0, columns).
struct FoundPoint {
  int id = 0;  ///< the same in all panoramas
  Eigen::Vector2d then = Eigen::Vector2d::Zero();
  Eigen::Vector2d now = Eigen::Vector2d::Zero();
  Eigen::Vector2d variance_px2 = Eigen::Vector2d::Zero();  ///< of `now`
};

/// Whether a place in a band is not covered by the vehicle: 0 in `seen`, as large as the band; empty: nothing is.
bool is_seen(const cv::Mat& seen, const Eigen::Vector2d& in_band);

/// Corners on all sides of a reference panorama, tracked in the following panoramas by patch alignment.
class PointField {
 public:
  PointField() = default;
  /// Takes the best corner of each cell, except in the sky, because clouds drift, and where the vehicle covers the view:
  /// 0 in `seen`, as large as the band; may be empty.
  PointField(const RoundBand& reference, const PointParameters& parameters, const cv::Mat& seen = {});

  std::size_t size() const { return points_.size(); }

  /// Drops the points that the vehicle covered in the reference.
  void keep_seen(const cv::Mat& seen);

  /// Expected magnification from the reference at `then` to the current panorama at `now`; px in the band.
  using Magnification = std::function<double(const Eigen::Vector2d& then, const Eigen::Vector2d& now)>;

  /// Tracks the points; call for all panoramas in order. `shift_px` maps a column of the last panorama to the
  /// approximate shift since then. A point that is missed three times in a row is dropped.
  template <class Shift>
  std::vector<FoundPoint> follow(const RoundBand& now, const Shift& shift_px, const Magnification& magnification) {
    for (Point& point : points_) point.at.x() += shift_px(point.at.x());
    return find(now, magnification);
  }

 private:
  struct Point {
    int id;
    Eigen::Vector2d then, at;  // in the reference; in the last panorama
    vision::PatchTemplate half;
    std::optional<vision::PatchTemplate> full;  // at the last expected magnification
    double magnified = 1.0;                     // magnification of `full`
    int missed = 0;
  };

  std::vector<FoundPoint> find(const RoundBand& now, const Magnification& magnification);
  void magnify(Point& point, double magnification) const;

  PointParameters parameters_;
  cv::Mat reference_;  // with margins
  std::vector<Point> points_;
};

}  // namespace panvo::panoramic_compass
