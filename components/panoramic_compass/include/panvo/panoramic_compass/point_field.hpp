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

/// A band of a panorama with a margin at either end that repeats the other end, at full and half size.
struct RoundBand {
  static constexpr int kMargin_px = 64;

  int columns = 0;  ///< of the full turn
  vision::ImagePyramid pyramid;
  double sky_grey = 256.0;  ///< where nothing is darker than this there is only sky; 256: not known

  RoundBand() = default;
  /// `band`: CV_8UC1, a full turn.
  explicit RoundBand(const cv::Mat& band, double darkest_sky = 256.0);
};

/// A point of the reference panorama found in another one; px of the band, u in [0, columns).
struct FoundPoint {
  Eigen::Vector2d then = Eigen::Vector2d::Zero();
  Eigen::Vector2d now = Eigen::Vector2d::Zero();
  Eigen::Vector2d variance_px2 = Eigen::Vector2d::Zero();  ///< of `now`
};

/// Well-marked points all round a reference panorama, to be found again in the panoramas that follow, on the pixels.
class PointField {
 public:
  PointField() = default;
  /// The best corner of each cell; none where there is only sky: clouds drift.
  PointField(const RoundBand& reference, const PointParameters& parameters);

  std::size_t size() const { return points_.size(); }

  /// How many times larger what the reference shows at `then` looks at `now`; px of the band.
  using Magnification = std::function<double(const Eigen::Vector2d& then, const Eigen::Vector2d& now)>;

  /// Finds the points, in order of panoramas. `shift_px` takes a column of the last panorama to about how far things there
  /// moved since. What is not found three times running is given up.
  template <class Shift>
  std::vector<FoundPoint> follow(const RoundBand& now, const Shift& shift_px, const Magnification& magnification) {
    for (Point& point : points_) point.at.x() += shift_px(point.at.x());
    return find(now, magnification);
  }

 private:
  struct Point {
    Eigen::Vector2d then, at;  // of the reference; where it was last
    vision::PatchTemplate half;
    std::optional<vision::PatchTemplate> full;  // as large as it was last expected to look
    double magnified = 1.0;                     // by how much that is
    int missed = 0;
  };

  std::vector<FoundPoint> find(const RoundBand& now, const Magnification& magnification);
  void magnify(Point& point, double magnification) const;

  PointParameters parameters_;
  cv::Mat reference_;  // with its margins
  std::vector<Point> points_;
};

}  // namespace panvo::panoramic_compass
