// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/camera_model.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "panvo/vision/lens_projection.hpp"
#include "positive.hpp"

namespace panvo::vision {
namespace {

using std::numbers::pi;

constexpr double kDegrees = 180.0 / pi;
constexpr double kScanStep_rad = 0.1 / kDegrees;
constexpr int kScanAzimuths = 16;  // tangential distortion makes the limit depend on the azimuth
constexpr int kBisections = 40;
constexpr int kGuessBisections = 12;
constexpr int kNewtonSteps = 30;
constexpr double kConverged = 1e-14;  // in the normalised image
constexpr double kAccepted = 1e-11;   // in the normalised image: below 1e-7 px for any camera
constexpr double kSlack = 1e-9;       // includes points on the limit despite rounding

/// Inverts the distortion of a lens up to a radius in the normalised image.
template <LensFormula Formula>
class Inversion {
 public:
  Inversion(const double* coefficients, double widest_radius) : c_(coefficients), widest_radius_(widest_radius) {}

  /// The point before distortion; nullopt if it lies beyond the radius.
  std::optional<Eigen::Vector2d> undistort(const Eigen::Vector2d& distorted) const {
    Eigen::Vector2d ideal = first_guess(distorted);
    double error = 0.0;
    for (int i = 0; i < kNewtonSteps; ++i) {
      const auto distortion = distortion_at<Formula>(c_, ideal);
      const Eigen::Vector2d difference = distorted - distortion.apply(ideal);
      error = difference.norm();
      if (error < kConverged) break;
      ideal += distortion.jacobian(ideal).inverse() * difference;
      if (!(ideal.norm() < 2.0 * widest_radius_)) return std::nullopt;
    }
    const bool is_within = ideal.norm() <= widest_radius_ * (1.0 + kSlack);
    if (!(error < kAccepted * std::max(1.0, distorted.norm())) || !is_within) return std::nullopt;
    return ideal;
  }

 private:
  /// Initial value for Newton's method: a point in the same direction with approximately the right distorted radius.
  Eigen::Vector2d first_guess(const Eigen::Vector2d& distorted) const {
    const double wanted = distorted.norm();
    if (wanted == 0.0) return distorted;
    const Eigen::Vector2d direction = distorted / wanted;
    double low = 0.0;
    double high = widest_radius_;
    for (int i = 0; i < kGuessBisections; ++i) {
      const double middle = 0.5 * (low + high);
      const Eigen::Vector2d ideal = middle * direction;
      (distortion_at<Formula>(c_, ideal).apply(ideal).norm() < wanted ? low : high) = middle;
    }
    return 0.5 * (low + high) * direction;
  }

  const double* c_;
  double widest_radius_;
};

/// Whether the distortion is invertible at the angle theta from the axis.
template <LensFormula Formula>
bool is_invertible(const double* c, double theta) {
  const double r = Formula::radius(c, theta);
  for (int i = 0; i < kScanAzimuths; ++i) {
    const double azimuth = 2.0 * pi * i / kScanAzimuths;
    const Eigen::Vector2d ideal(r * std::cos(azimuth), r * std::sin(azimuth));
    const Eigen::Matrix2d jacobian = distortion_at<Formula>(c, ideal).jacobian(ideal);
    if (!(jacobian.determinant() > 0.0 && jacobian.trace() > 0.0)) return false;
  }
  return true;
}

/// Largest angle up to which the distortion is invertible, at most the limit of the model.
template <LensFormula Formula>
double fold_rad(const double* c) {
  const double limit = Formula::limit_rad(c);
  double sound = 0.0;
  while (sound < limit) {
    double next = std::min(limit, sound + kScanStep_rad);
    if (is_invertible<Formula>(c, next)) {
      sound = next;
      continue;
    }
    for (int i = 0; i < kBisections; ++i) {
      const double middle = 0.5 * (sound + next);
      (is_invertible<Formula>(c, middle) ? sound : next) = middle;
    }
    break;
  }
  return sound;
}

}  // namespace

CameraModel::CameraModel(const LensCamera& camera, double field_of_view_rad) : camera_(camera) {
  check_numbers();
  const double* c = camera_.distortion.data();
  const auto [model_limit, fold] = visit_lens(camera.model, [&]<LensFormula Formula>(const Formula& /*formula*/) {
    return std::pair(Formula::limit_rad(c), fold_rad<Formula>(c));
  });
  const double wanted = 0.5 * field_of_view_rad;
  if (field_of_view_rad < 0.0 || !(wanted <= model_limit)) {
    std::ostringstream text;
    text << "has a field of view of " << field_of_view_rad * kDegrees << " degrees; the lens model "
         << ros_name(camera.model) << " supports up to " << 2.0 * model_limit * kDegrees
         << ": correct the field of view or calibrate with a wider model";
    throw std::invalid_argument(text.str());
  }
  if (wanted > fold) {
    std::ostringstream text;
    text << "has a distortion that is not invertible beyond " << fold * kDegrees
         << " degrees off axis, inside its field of view of " << field_of_view_rad * kDegrees
         << " degrees; calibrate with the board near the image borders or set a smaller field of view";
    throw std::invalid_argument(text.str());
  }
  widest_rad_ = wanted > 0.0 ? wanted : fold;
  widest_radius_ = visit_lens(camera.model, [&](const auto& formula) { return formula.radius(c, widest_rad_); });
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
  } else if (!std::all_of(camera_.distortion.begin(), camera_.distortion.end(),
                          [](double value) { return std::isfinite(value); })) {
    text << "has a distortion coefficient that is not a number; calibrate again";
  }
  const auto coefficients = lens_coefficients(camera_.model);
  for (std::size_t i = 0; i < coefficients.size() && text.view().empty(); ++i) {
    const auto& [name, start, min, max, is_optional] = coefficients[i];
    const double value = camera_.distortion.at(i);
    if (value < min) text << "has coefficient " << name << " = " << value << "; it must be " << min << " or more";
    if (value > max) text << "has coefficient " << name << " = " << value << "; it must be " << max << " or less";
  }
  if (!text.view().empty()) throw std::invalid_argument(text.str());
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
  const bool is_perspective = visit_lens(camera_.model, [](const auto& formula) { return formula.kIsPerspective; });
  const std::size_t checked = is_perspective ? borders.size() : 1;
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

std::optional<Eigen::Vector2d> CameraModel::project(const Eigen::Vector3d& point) const {
  const auto off_axis = off_axis_of(point);
  if (!(off_axis.angle_rad <= widest_rad_ + kSlack)) return std::nullopt;
  const auto place = visit_lens(camera_.model, [&]<LensFormula Formula>(const Formula& /*formula*/) {
    return project_direction<Formula>(camera_.distortion.data(), point, off_axis);
  });
  if (!place) return std::nullopt;
  const auto& p = camera_.pinhole;
  return Eigen::Vector2d(p.fx * place->x() + p.cx, p.fy * place->y() + p.cy);
}

std::optional<Eigen::Vector3d> CameraModel::unproject(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d distorted = camera_.pinhole.unproject(pixel).head<2>();
  const double* c = camera_.distortion.data();
  return visit_lens(camera_.model,
                    [&]<LensFormula Formula>(const Formula& /*formula*/) -> std::optional<Eigen::Vector3d> {
                      const auto ideal = Inversion<Formula>(c, widest_radius_).undistort(distorted);
                      if (!ideal) return std::nullopt;
                      return Formula::direction(c, *ideal);
                    });
}

}  // namespace panvo::vision
