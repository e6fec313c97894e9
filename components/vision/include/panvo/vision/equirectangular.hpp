// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace panvo::vision {

/// Panorama by longitude and latitude, `columns` x `rows` px, 2:1 for the whole sphere. Camera frame optical: X right, Y down,
/// Z forward. Pixel centres lie at integer coordinates and [Lu2015 Eq. 10] holds for them as it is printed: pixel (0, 0) looks
/// backwards and straight up, column columns/2 forward, row rows/2 at the horizon; u grows to the right, v downward.
struct Equirectangular {
  int columns = 0;
  int rows = 0;

  /// Pixel that shows a direction, u in [0, columns): theta = atan2(X, Z), phi = atan2(Y, sqrt(X^2 + Z^2)) [Lu2015 Eq. 9, with
  /// its arcsin(Y / r) corrected: that is undefined for |Y| > r]. The length of the direction does not matter; not zero.
  Eigen::Vector2d project(const Eigen::Vector3d& direction) const;

  /// Unit vector through a pixel; u may lie beyond the image's left and right border.
  Eigen::Vector3d unproject(const Eigen::Vector2d& pixel) const;

  double azimuth_rad(
      double u) const;  ///< theta of a column, clockwise from straight ahead; not wrapped [Lu2015 Eq. 10]
  double elevation_rad(double v) const;     ///< phi of a row, positive below the horizon [Lu2015 Eq. 10]
  double column(double azimuth_rad) const;  ///< not wrapped
  double row(double elevation_rad) const;
};

/// What keeps an image from being an equirectangular panorama of 8 bits, in words that follow its name ("is not twice as wide as high:
/// ..."); nullopt for one that is at least `smallest_columns` wide.
std::optional<std::string> find_layout_fault(const cv::Mat& panorama, int smallest_columns);

/// The same difference of columns, or angle, modulo a full turn: in (-turn/2, turn/2].
double wrap(double difference, double turn);
inline double wrap_columns(double difference, int columns) { return wrap(difference, columns); }

}  // namespace panvo::vision
