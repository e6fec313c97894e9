// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace panvo::vision {

/// Equirectangular panorama, `columns` x `rows` px, 2:1 for the full sphere. Optical camera frame: X right, Y down, Z
/// forward. Pixel centres lie at integer coordinates, and [Lu2015 Eq. 10] applies as printed: pixel (0, 0) looks
/// backwards and straight up, column columns/2 forward, row rows/2 at the horizon; u grows to the right, v downward.
struct Equirectangular {
  int columns = 0;
  int rows = 0;

  /// Pixel of a direction (any non-zero length), u in [0, columns): theta = atan2(X, Z), phi = atan2(Y, sqrt(X^2 +
  /// Z^2)) [Lu2015 Eq. 9, with its arcsin(Y / r) corrected: that is undefined for |Y| > r].
  Eigen::Vector2d project(const Eigen::Vector3d& direction) const;

  /// Unit vector through a pixel; u may lie beyond the left and right image border.
  Eigen::Vector3d unproject(const Eigen::Vector2d& pixel) const;

  double azimuth_rad(
      double u) const;  ///< theta of a column, clockwise from straight ahead; not wrapped [Lu2015 Eq. 10]
  double elevation_rad(double v) const;     ///< phi of a row, positive below the horizon [Lu2015 Eq. 10]
  double column(double azimuth_rad) const;  ///< not wrapped
  double row(double elevation_rad) const;
};

/// Returns why an image is not an 8-bit equirectangular panorama of at least `min_columns` columns, as text to
/// follow its name ("is not twice as wide as high: ..."); nullopt if it is one.
std::optional<std::string> find_layout_fault(const cv::Mat& panorama, int min_columns);

/// Wraps a difference of columns or angles to (-turn/2, turn/2].
double wrap(double difference, double turn);
inline double wrap_columns(double difference, int columns) { return wrap(difference, columns); }

}  // namespace panvo::vision
