// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/camera_rays.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace panvo::simulated_world {
namespace {

constexpr int kNewtonSteps = 40;
constexpr double kConverged = 1e-12;      // on the normalised image plane: far below 1e-3 px
constexpr double kWidestTangent = 100.0;  // 89.4 degrees off the axis

void check_camera(const vision::PinholeCamera& camera) {
  const auto is_positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  if (!is_positive(camera.fx) || !is_positive(camera.fy)) {
    throw std::invalid_argument(
        fmt::format("camera: focal lengths fx = {}, fy = {} px must be positive numbers", camera.fx, camera.fy));
  }
  if (!std::isfinite(camera.cx) || !std::isfinite(camera.cy)) {
    throw std::invalid_argument(
        fmt::format("camera: principal point ({}, {}) px must be numbers", camera.cx, camera.cy));
  }
  if (camera.width <= 0 || camera.height <= 0) {
    throw std::invalid_argument(
        fmt::format("camera: image size {} x {} px must be positive", camera.width, camera.height));
  }
}

/// Radial-tangential distortion of the normalised image plane and its derivative.
struct Distortion {
  std::array<double, 5> coefficients{};

  Eigen::Vector2d distort(const Eigen::Vector2d& ideal, Eigen::Matrix2d& jacobian) const {
    const auto [k1, k2, p1, p2, k3] = coefficients;
    const double x = ideal.x();
    const double y = ideal.y();
    const double r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
    const double slope = 2.0 * (k1 + r2 * (2.0 * k2 + 3.0 * r2 * k3));  // of `radial`, per r dr
    jacobian << radial + x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x, x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y,
        x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y, radial + y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x;
    return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
            y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
  }

  /// The undistorted position on the normalised image plane, by Newton's method; throws if there is none.
  Eigen::Vector2d undistort(const Eigen::Vector2d& distorted) const {
    Eigen::Vector2d ideal = distorted;
    Eigen::Matrix2d jacobian;
    for (int i = 0; i < kNewtonSteps; ++i) {
      const Eigen::Vector2d error = distorted - distort(ideal, jacobian);
      if (error.norm() < kConverged) return ideal;
      ideal += jacobian.inverse() * error;
      if (!(ideal.norm() < kWidestTangent)) break;
    }
    throw_folded(distorted);
  }

  /// Throws if the image is folded over anywhere between its centre and `ideal`.
  void check_unfolded(const Eigen::Vector2d& ideal) const {
    Eigen::Matrix2d jacobian;
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {
      distort(share * ideal, jacobian);
      if (jacobian.determinant() <= 0.0 || jacobian.trace() <= 0.0) throw_folded(ideal);
    }
  }

  [[noreturn]] void throw_folded(const Eigen::Vector2d& where) const {
    throw std::invalid_argument(fmt::format(
        "camera: the distortion ({:.4g}, {:.4g}, {:.4g}, {:.4g}, {:.4g}) folds the image over, or its field of view is "
        "180 degrees or more, near ({:.3f}, {:.3f}) of the normalised image plane; use coefficients fitted to the "
        "whole image, or the fisheye model",
        coefficients[0], coefficients[1], coefficients[2], coefficients[3], coefficients[4], where.x(), where.y()));
  }
};

CameraRays empty_rays(int width, int height) {
  CameraRays rays{width, height, {}};
  rays.directions.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), Eigen::Vector3f::Zero());
  return rays;
}

}  // namespace

Eigen::Vector3f CameraRays::direction(float column, float row) const {
  // beyond the border, the table is extrapolated linearly
  const auto cell = [](float place, int size) { return std::clamp(static_cast<int>(std::floor(place)), 0, size - 2); };
  const int left = wraps ? static_cast<int>(std::floor(column)) : width > 1 ? cell(column, width) : 0;
  const int top = height > 1 ? cell(row, height) : 0;
  const float across = column - static_cast<float>(left);
  const float down = row - static_cast<float>(top);
  const auto entry = [&](int x, int y) -> const Eigen::Vector3f& {
    if (wraps) x = (x % width + width) % width;
    x = std::min(x, width - 1);
    y = std::min(y, height - 1);
    return directions[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  };
  const Eigen::Vector3f& top_left = entry(left, top);
  const Eigen::Vector3f& top_right = entry(left + 1, top);
  const Eigen::Vector3f& bottom_left = entry(left, top + 1);
  const Eigen::Vector3f& bottom_right = entry(left + 1, top + 1);
  if (top_left.isZero() || top_right.isZero() || bottom_left.isZero() || bottom_right.isZero()) {
    return entry(left + (across > 0.5f ? 1 : 0), top + (down > 0.5f ? 1 : 0));  // at the edge of a fisheye's view
  }
  const Eigen::Vector3f upper = top_left + across * (top_right - top_left);
  const Eigen::Vector3f lower = bottom_left + across * (bottom_right - bottom_left);
  return (upper + down * (lower - upper)).normalized();
}

CameraRays pinhole_rays(const vision::LensCamera& camera) {
  const auto& pinhole = camera.pinhole;
  check_camera(pinhole);
  if (camera.model != vision::LensModel::kPlumbBob) throw std::invalid_argument("camera: the lens must be plumb_bob");
  Distortion distortion;
  std::copy_n(camera.distortion.begin(), distortion.coefficients.size(), distortion.coefficients.begin());
  CameraRays rays = empty_rays(pinhole.width, pinhole.height);
  auto direction = rays.directions.begin();
  for (int row = 0; row < rays.height; ++row) {
    for (int column = 0; column < rays.width; ++column) {
      const Eigen::Vector2d ideal = distortion.undistort(pinhole.unproject({column, row}).head<2>());
      if (row == 0 || column == 0 || row + 1 == rays.height || column + 1 == rays.width) {
        distortion.check_unfolded(ideal);  // along every line to the border
      }
      *direction++ = ideal.homogeneous().normalized().cast<float>();
    }
  }
  return rays;
}

CameraRays panorama_rays(int width, int height) {
  if (width <= 0 || height <= 0) {
    throw std::invalid_argument(fmt::format("panorama: image size {} x {} px must be positive", width, height));
  }
  CameraRays rays = empty_rays(width, height);
  rays.wraps = true;
  auto direction = rays.directions.begin();
  for (int row = 0; row < height; ++row) {
    const double elevation = std::numbers::pi * row / height - std::numbers::pi / 2.0;  // downwards
    for (int column = 0; column < width; ++column) {
      const double azimuth = 2.0 * std::numbers::pi * column / width - std::numbers::pi;
      *direction++ = Eigen::Vector3d(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                     std::cos(elevation) * std::cos(azimuth))
                         .cast<float>();
    }
  }
  return rays;
}

CameraRays fisheye_rays(const FisheyeCamera& camera) {
  check_camera(camera.pinhole);
  if (!(camera.field_of_view_rad > 0.0 && camera.field_of_view_rad <= 2.0 * std::numbers::pi)) {
    throw std::invalid_argument(
        fmt::format("fisheye: a field of view of {} rad must lie in (0, 2 pi]", camera.field_of_view_rad));
  }
  const double k1 = camera.distortion[0], k2 = camera.distortion[1], k3 = camera.distortion[2],
               k4 = camera.distortion[3];
  const auto radius = [&](double t) {
    const double t2 = t * t;
    return t * (1.0 + t2 * (k1 + t2 * (k2 + t2 * (k3 + t2 * k4))));
  };
  const auto slope = [&](double t) {
    const double t2 = t * t;
    return 1.0 + t2 * (3.0 * k1 + t2 * (5.0 * k2 + t2 * (7.0 * k3 + t2 * 9.0 * k4)));
  };
  const double widest = camera.field_of_view_rad / 2.0;
  for (int i = 0; i <= 100; ++i) {
    if (!(slope(widest * i / 100.0) > 0.0)) {
      throw std::invalid_argument(
          fmt::format("fisheye: the distortion folds the image over at {:.2f} rad off the axis; use coefficients that "
                      "are valid to half of the field of view, {:.2f} rad",
                      widest * i / 100.0, widest));
    }
  }
  CameraRays rays = empty_rays(camera.pinhole.width, camera.pinhole.height);
  auto direction = rays.directions.begin();
  for (int row = 0; row < rays.height; ++row) {
    for (int column = 0; column < rays.width; ++column, ++direction) {
      const Eigen::Vector2d place = camera.pinhole.unproject({column, row}).head<2>();
      const double distance = place.norm();
      if (distance > radius(widest)) continue;
      // r(t) is monotonic: bisection first, so that Newton's method starts near the root
      double low = 0.0;
      double high = widest;
      for (int i = 0; i < 8; ++i) (radius(0.5 * (low + high)) < distance ? low : high) = 0.5 * (low + high);
      double angle = 0.5 * (low + high);
      for (int i = 0; i < 6; ++i) angle = std::clamp(angle - (radius(angle) - distance) / slope(angle), low, high);
      const Eigen::Vector2d around =
          distance > 0.0 ? Eigen::Vector2d(place / distance) : Eigen::Vector2d(Eigen::Vector2d::Zero());
      *direction =
          Eigen::Vector3d(std::sin(angle) * around.x(), std::sin(angle) * around.y(), std::cos(angle)).cast<float>();
    }
  }
  return rays;
}

}  // namespace panvo::simulated_world
