// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/camera_model.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "positive.hpp"

namespace panvo::vision {
namespace {

using std::numbers::pi;

constexpr double kDegrees = 180.0 / pi;
constexpr double kWidestPerspective_rad = 89.0 / kDegrees;
constexpr double kPoleDistance_rad = 0.5 / kDegrees;  // from the pole of the Mei model
constexpr double kScanStep_rad = 0.1 / kDegrees;
constexpr int kScanAzimuths = 16;  // tangential distortion makes the limit depend on the azimuth
constexpr int kBisections = 40;
constexpr int kGuessBisections = 12;
constexpr int kNewtonSteps = 30;
constexpr double kConverged = 1e-14;  // in the normalised image
constexpr double kAccepted = 1e-11;   // in the normalised image: below 1e-7 px for any camera
constexpr double kSlack = 1e-9;       // includes points on the limit despite rounding

}  // namespace

CameraModel::CameraModel(const LensCamera& camera, double field_of_view_rad) : camera_(camera) {
  check_numbers();
  const double model_limit = model_limit_rad();
  const double wanted = 0.5 * field_of_view_rad;
  if (field_of_view_rad < 0.0 || !(wanted <= model_limit)) {
    std::ostringstream text;
    text << "has a field of view of " << field_of_view_rad * kDegrees << " degrees; the lens model "
         << ros_name(camera.model) << " supports up to " << 2.0 * model_limit * kDegrees
         << ": correct the field of view or calibrate with a wider model";
    throw std::invalid_argument(text.str());
  }
  const double fold = fold_rad();
  if (wanted > fold) {
    std::ostringstream text;
    text << "has a distortion that is not invertible beyond " << fold * kDegrees
         << " degrees off axis, inside its field of view of " << field_of_view_rad * kDegrees
         << " degrees; calibrate with the board near the image borders or set a smaller field of view";
    throw std::invalid_argument(text.str());
  }
  widest_rad_ = wanted > 0.0 ? wanted : fold;
  widest_radius_ = radius(widest_rad_);
  if (wanted == 0.0) check_borders();
}

void CameraModel::check_numbers() const {
  const auto& p = camera_.pinhole;
  std::ostringstream text;
  if (!is_positive(p.fx) || !is_positive(p.fy)) {
    text << "has focal lengths fx = " << p.fx << ", fy = " << p.fy
         << " px; they must be positive: calibrate the camera";
  } else if (!std::isfinite(p.cx) || !std::isfinite(p.cy)) {
    text << "has a principal point that is not a number; calibrate again";
  } else if (p.width <= 0 || p.height <= 0) {
    text << "has an image size of " << p.width << " x " << p.height << " px; set the size of the calibration images";
  } else if (!(camera_.xi >= 0.0 && std::isfinite(camera_.xi))) {
    text << "has mirror parameter xi = " << camera_.xi << "; it must be 0 or more";
  } else if (!std::all_of(camera_.distortion.begin(), camera_.distortion.end(),
                          [](double value) { return std::isfinite(value); })) {
    text << "has a distortion coefficient that is not a number; calibrate again";
  } else {
    return;
  }
  throw std::invalid_argument(text.str());
}

/// Without a given field of view, the distortion must be invertible up to the nearest border; for perspective lenses,
/// up to all four.
void CameraModel::check_borders() const {
  const auto& p = camera_.pinhole;
  std::array<Eigen::Vector2d, 4> borders{Eigen::Vector2d{0.0, p.cy}, Eigen::Vector2d{p.width - 1.0, p.cy},
                                         Eigen::Vector2d{p.cx, 0.0}, Eigen::Vector2d{p.cx, p.height - 1.0}};
  const Eigen::Vector2d centre(p.cx, p.cy);
  std::sort(borders.begin(), borders.end(),
            [&](const auto& a, const auto& b) { return (a - centre).norm() < (b - centre).norm(); });
  const std::size_t checked = is_perspective() ? borders.size() : 1;
  for (std::size_t i = 0; i < checked; ++i) {
    if (!p.contains(borders[i]) || unproject(borders[i])) continue;
    std::ostringstream text;
    text << "has a distortion that is not invertible beyond " << widest_rad_ * kDegrees
         << " degrees off axis, inside its border at pixel (" << borders[i].x() << ", " << borders[i].y()
         << "); calibrate with the board near the image borders or with a wider model, or set the field of view if the "
            "image is circular";
    throw std::invalid_argument(text.str());
  }
}

bool CameraModel::is_perspective() const {
  return camera_.model == LensModel::kPlumbBob || camera_.model == LensModel::kRational;
}

double CameraModel::radius(double theta_rad) const {
  switch (camera_.model) {
    case LensModel::kEquidistant:
      return theta_rad;
    case LensModel::kMei:
      return std::sin(theta_rad) / (std::cos(theta_rad) + camera_.xi);
    case LensModel::kPlumbBob:
    case LensModel::kRational:
      break;
  }
  return std::tan(theta_rad);
}

/// Largest angle up to which the radius is monotonic.
double CameraModel::model_limit_rad() const {
  if (is_perspective()) return kWidestPerspective_rad;
  if (camera_.model == LensModel::kEquidistant) return pi;
  return std::acos(camera_.xi > 1.0 ? -1.0 / camera_.xi : -camera_.xi) - kPoleDistance_rad;
}

/// Largest angle up to which the distortion is invertible, at most the model limit.
double CameraModel::fold_rad() const {
  const auto is_sound = [&](double theta) {
    const double r = radius(theta);
    for (int i = 0; i < kScanAzimuths; ++i) {
      const double azimuth = 2.0 * pi * i / kScanAzimuths;
      Eigen::Matrix2d jacobian;
      distort({r * std::cos(azimuth), r * std::sin(azimuth)}, &jacobian);
      if (!(jacobian.determinant() > 0.0 && jacobian.trace() > 0.0)) return false;
    }
    return true;
  };
  const double limit = model_limit_rad();
  double sound = 0.0;
  while (sound < limit) {
    double next = std::min(limit, sound + kScanStep_rad);
    if (is_sound(next)) {
      sound = next;
      continue;
    }
    for (int i = 0; i < kBisections; ++i) {
      const double middle = 0.5 * (sound + next);
      (is_sound(middle) ? sound : next) = middle;
    }
    break;
  }
  return sound;
}

Eigen::Vector2d CameraModel::distort(const Eigen::Vector2d& ideal, Eigen::Matrix2d* jacobian) const {
  const auto& d = camera_.distortion;
  const double x = ideal.x();
  const double y = ideal.y();
  const double r2 = x * x + y * y;
  double radial = 0.0;
  double slope = 0.0;  // d radial / d r2
  double p1 = 0.0;
  double p2 = 0.0;
  if (camera_.model == LensModel::kEquidistant) {
    radial = 1.0 + r2 * (d[0] + r2 * (d[1] + r2 * (d[2] + r2 * d[3])));
    slope = d[0] + r2 * (2.0 * d[1] + r2 * (3.0 * d[2] + r2 * 4.0 * d[3]));
  } else {
    const double above = 1.0 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
    const double below = 1.0 + r2 * (d[5] + r2 * (d[6] + r2 * d[7]));
    const double above_slope = d[0] + r2 * (2.0 * d[1] + r2 * 3.0 * d[4]);
    const double below_slope = d[5] + r2 * (2.0 * d[6] + r2 * 3.0 * d[7]);
    radial = above / below;
    slope = (above_slope - radial * below_slope) / below;
    p1 = d[2];
    p2 = d[3];
  }
  if (jacobian != nullptr) {
    const double cross = 2.0 * (x * y * slope + p1 * x + p2 * y);
    *jacobian << radial + 2.0 * x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x, cross, cross,
        radial + 2.0 * y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x;
  }
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

/// Initial value for Newton's method: a point in the same direction with approximately the right distorted radius.
Eigen::Vector2d CameraModel::first_guess(const Eigen::Vector2d& distorted) const {
  const double wanted = distorted.norm();
  if (wanted == 0.0) return distorted;
  const Eigen::Vector2d direction = distorted / wanted;
  double low = 0.0;
  double high = widest_radius_;
  for (int i = 0; i < kGuessBisections; ++i) {
    const double middle = 0.5 * (low + high);
    (distort(middle * direction, nullptr).norm() < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high) * direction;
}

std::optional<Eigen::Vector2d> CameraModel::undistort(const Eigen::Vector2d& distorted) const {
  Eigen::Vector2d ideal = first_guess(distorted);
  Eigen::Matrix2d jacobian;
  double error = 0.0;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Eigen::Vector2d difference = distorted - distort(ideal, &jacobian);
    error = difference.norm();
    if (error < kConverged) break;
    ideal += jacobian.inverse() * difference;
    if (!(ideal.norm() < 2.0 * widest_radius_)) return std::nullopt;
  }
  const bool is_within = ideal.norm() <= widest_radius_ * (1.0 + kSlack);
  if (!(error < kAccepted * std::max(1.0, distorted.norm())) || !is_within) return std::nullopt;
  return ideal;
}

std::optional<Eigen::Vector2d> CameraModel::project(const Eigen::Vector3d& point) const {
  const double off_axis = std::hypot(point.x(), point.y());
  const double theta = std::atan2(off_axis, point.z());
  if (!(theta <= widest_rad_ + kSlack) || (off_axis == 0.0 && !(point.z() > 0.0))) return std::nullopt;
  const double scale = off_axis > 0.0 ? radius(theta) / off_axis : 0.0;
  const Eigen::Vector2d place = distort(scale * point.head<2>(), nullptr);
  const auto& p = camera_.pinhole;
  return Eigen::Vector2d(p.fx * place.x() + p.cx, p.fy * place.y() + p.cy);
}

std::optional<Eigen::Vector3d> CameraModel::unproject(const Eigen::Vector2d& pixel) const {
  const auto ideal = undistort(camera_.pinhole.unproject(pixel).head<2>());
  if (!ideal) return std::nullopt;
  const double r = ideal->norm();
  switch (camera_.model) {
    case LensModel::kEquidistant: {
      const double along = r > 0.0 ? std::sin(r) / r : 1.0;
      return Eigen::Vector3d(along * ideal->x(), along * ideal->y(), std::cos(r));
    }
    case LensModel::kMei: {
      const double xi = camera_.xi;
      const double lift = (xi + std::sqrt(std::max(0.0, 1.0 + (1.0 - xi * xi) * r * r))) / (r * r + 1.0);
      return Eigen::Vector3d(lift * ideal->x(), lift * ideal->y(), lift - xi);
    }
    case LensModel::kPlumbBob:
    case LensModel::kRational:
      break;
  }
  return Eigen::Vector3d(ideal->homogeneous().normalized());
}

}  // namespace panvo::vision
