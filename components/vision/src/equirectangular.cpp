// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/equirectangular.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

namespace panvo::vision {

using std::numbers::pi;

double wrap(double difference, double turn) {
  const double wrapped = difference - turn * std::floor(difference / turn);  // [0, turn)
  return wrapped > 0.5 * turn ? wrapped - turn : wrapped;
}

std::optional<std::string> find_layout_fault(const cv::Mat& panorama, int min_columns) {
  std::ostringstream text;
  if (panorama.empty()) {
    text << "is empty";
  } else if (panorama.type() != CV_8UC1 && panorama.type() != CV_8UC3) {
    text << "is not an 8-bit image of 1 or 3 channels";
  } else if (panorama.cols != 2 * panorama.rows) {
    text << "is not twice as wide as high: " << panorama.cols << "x" << panorama.rows << " px";
  } else if (panorama.cols < min_columns) {
    text << "is too small: " << panorama.cols << "x" << panorama.rows << " px, " << min_columns << " columns needed";
  } else {
    return std::nullopt;
  }
  return text.str();
}

double Equirectangular::azimuth_rad(double u) const { return 2.0 * pi * u / columns - pi; }
double Equirectangular::elevation_rad(double v) const { return pi * v / rows - 0.5 * pi; }
double Equirectangular::column(double azimuth_rad) const { return (azimuth_rad + pi) * columns / (2.0 * pi); }
double Equirectangular::row(double elevation_rad) const { return (elevation_rad + 0.5 * pi) * rows / pi; }

Eigen::Vector2d Equirectangular::project(const Eigen::Vector3d& direction) const {
  const double theta = std::atan2(direction.x(), direction.z());
  const double phi = std::atan2(direction.y(), std::hypot(direction.x(), direction.z()));
  const double u = column(theta);
  return {u < columns ? u : 0.0, row(phi)};  // theta = pi is the same direction as -pi
}

Eigen::Vector3d Equirectangular::unproject(const Eigen::Vector2d& pixel) const {
  const double theta = azimuth_rad(pixel.x());
  const double phi = elevation_rad(pixel.y());
  return {std::cos(phi) * std::sin(theta), std::sin(phi), std::cos(phi) * std::cos(theta)};
}

}  // namespace panvo::vision
