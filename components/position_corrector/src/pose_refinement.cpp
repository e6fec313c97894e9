// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/pose_refinement.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "panvo/vision/robust_loss.hpp"

namespace panvo::position_corrector {
namespace {

constexpr int kMaxSteps = 20;
constexpr double kSmallStep = 1e-7;  // m and rad
constexpr double kLossScale = 2.5;   // standard deviations
constexpr double kUndetermined = 1e6;

using Matrix23d = Eigen::Matrix<double, 2, 3>;
using Matrix26d = Eigen::Matrix<double, 2, 6>;

/// Two directions perpendicular to a bearing, as rows.
Matrix23d across(const Eigen::Vector3d& bearing) {
  const Eigen::Vector3d helper = std::abs(bearing.y()) < 0.9 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  Matrix23d rows;
  rows.row(0) = bearing.cross(helper).normalized();
  rows.row(1) = bearing.cross(rows.row(0).transpose());
  return rows;
}

struct Whitened {
  Eigen::Vector2d residual;
  Matrix26d jacobian;  // by the pose error: translation, rotation vector, landmark axes
};

/// Angular residual between bearing and point, perpendicular to the bearing, in standard deviations.
std::optional<Whitened> whitened(const SightedPoint& sighting, const Eigen::Isometry3d& landmark_from_panorama,
                                 double bearing_sigma_rad) {
  const Eigen::Matrix3d rotation = landmark_from_panorama.linear();
  const Eigen::Vector3d away = sighting.point - landmark_from_panorama.translation();
  const double range = away.norm();
  if (range < 1e-6) return std::nullopt;
  const Eigen::Vector3d seen = rotation.transpose() * away / range;
  if (seen.dot(sighting.bearing) <= 0.0) return std::nullopt;
  const Matrix23d tangent = across(sighting.bearing);
  const Matrix23d by_point =
      tangent * (Eigen::Matrix3d::Identity() - seen * seen.transpose()) / range * rotation.transpose();
  const Eigen::Matrix2d covariance = bearing_sigma_rad * bearing_sigma_rad * Eigen::Matrix2d::Identity() +
                                     by_point * sighting.covariance * by_point.transpose();
  const Eigen::Matrix2d root = covariance.llt().matrixL();
  Whitened result;
  result.residual = root.triangularView<Eigen::Lower>().solve(tangent * seen);
  Matrix26d jacobian;
  jacobian << -by_point, by_point * vision::skew(away);
  result.jacobian = root.triangularView<Eigen::Lower>().solve(jacobian);
  return result;
}

Eigen::Isometry3d moved(const Eigen::Isometry3d& pose, const vision::Vector6d& step) {
  Eigen::Isometry3d result = pose;
  result.translation() += step.head<3>();
  result.linear() = vision::so3_exp(step.tail<3>()) * pose.linear();
  return result;
}

double cost_of(const Eigen::Isometry3d& pose, std::span<const SightedPoint> sightings, double sigma_rad,
               const vision::CauchyLoss& loss) {
  double cost = 0.0;
  for (const auto& sighting : sightings) {
    const auto term = whitened(sighting, pose, sigma_rad);
    // a point behind the camera counts as a large residual
    cost += loss.cost(term ? term->residual.squaredNorm() : 1e4);
  }
  return cost;
}

/// The sightings at a pose, with their robust weights.
struct Fit {
  std::vector<vision::Matrix6d> information;  // of each
  double squares = 0.0, freedom = 0.0;
};

Fit fit_at(const Eigen::Isometry3d& pose, std::span<const SightedPoint> sightings, double bearing_sigma_rad) {
  const vision::CauchyLoss loss(kLossScale);
  Fit fit;
  double weights = 0.0;
  for (const auto& sighting : sightings) {
    const auto term = whitened(sighting, pose, bearing_sigma_rad);
    if (!term) continue;
    const double square = term->residual.squaredNorm();
    const double weight = loss.weight(square);
    fit.information.emplace_back(weight * term->jacobian.transpose() * term->jacobian);
    fit.squares += weight * square;
    weights += weight;
  }
  fit.freedom = 2.0 * weights - 6.0;
  return fit;
}

vision::Matrix6d sum_of(const std::vector<vision::Matrix6d>& information) {
  vision::Matrix6d sum = vision::Matrix6d::Zero();
  for (const auto& one : information) sum += one;
  return sum;
}

}  // namespace

double squared_residual(const SightedPoint& sighting, const Eigen::Isometry3d& landmark_from_panorama,
                        double bearing_sigma_rad) {
  const auto term = whitened(sighting, landmark_from_panorama, bearing_sigma_rad);
  return term ? term->residual.squaredNorm() : std::numeric_limits<double>::infinity();
}

RefinedPose refine_pose(const Eigen::Isometry3d& start, std::span<const SightedPoint> sightings,
                        double bearing_sigma_rad) {
  const vision::CauchyLoss loss(kLossScale);
  Eigen::Isometry3d pose = start;
  double cost = cost_of(pose, sightings, bearing_sigma_rad, loss);
  double damping = 1e-4;
  for (int step = 0; step < kMaxSteps; ++step) {
    vision::Matrix6d information = vision::Matrix6d::Zero();
    vision::Vector6d gradient = vision::Vector6d::Zero();
    for (const auto& sighting : sightings) {
      const auto term = whitened(sighting, pose, bearing_sigma_rad);
      if (!term) continue;
      const double weight = loss.weight(term->residual.squaredNorm());
      information += weight * term->jacobian.transpose() * term->jacobian;
      gradient += weight * term->jacobian.transpose() * term->residual;
    }
    bool improved = false;
    vision::Vector6d change = vision::Vector6d::Zero();
    for (; damping < 1e8 && !improved; damping *= improved ? 1.0 : 10.0) {
      vision::Matrix6d damped = information;
      damped.diagonal() += damping * information.diagonal();
      change = -damped.ldlt().solve(gradient);
      if (!change.allFinite()) continue;
      const auto tried = moved(pose, change);
      const double tried_cost = cost_of(tried, sightings, bearing_sigma_rad, loss);
      if (tried_cost > cost) continue;
      improved = true;
      pose = tried;
      cost = tried_cost;
    }
    damping *= 0.1;
    if (!improved || change.norm() < kSmallStep) break;
  }

  RefinedPose refined;
  refined.landmark_from_panorama = pose;
  const auto fit = fit_at(pose, sightings, bearing_sigma_rad);
  refined.mean_square = fit.freedom > 0.0 ? fit.squares / fit.freedom : std::numeric_limits<double>::infinity();
  const vision::Matrix6d information = sum_of(fit.information);
  const Eigen::SelfAdjointEigenSolver<vision::Matrix6d> solver(information);
  if (fit.freedom <= 0.0 || solver.eigenvalues().minCoeff() < 1e-6) {
    refined.landmark_from_panorama = start;
    refined.covariance = kUndetermined * vision::Matrix6d::Identity();
    return refined;
  }
  refined.covariance = std::max(1.0, refined.mean_square) * information.inverse();
  return refined;
}

vision::Matrix6d covariance_without_most_informative(const RefinedPose& refined,
                                                     std::span<const SightedPoint> sightings, double bearing_sigma_rad,
                                                     int spare) {
  auto each = fit_at(refined.landmark_from_panorama, sightings, bearing_sigma_rad).information;
  // What nothing determines has the variance of an undetermined pose.
  vision::Matrix6d left = sum_of(each) + vision::Matrix6d::Identity() / kUndetermined;
  vision::Matrix6d covariance = left.inverse();
  for (; spare > 0 && !each.empty(); --spare) {
    std::size_t most = 0;
    double largest = -1.0;
    for (std::size_t i = 0; i < each.size(); ++i) {
      const vision::Matrix6d without = (left - each[i]).inverse();
      const double variance = without.topLeftCorner<3, 3>().trace();
      if (variance <= largest) continue;
      largest = variance;
      most = i;
      covariance = without;
    }
    left -= each[most];
    each.erase(each.begin() + static_cast<std::ptrdiff_t>(most));
  }
  return std::max(1.0, refined.mean_square) * covariance;
}

}  // namespace panvo::position_corrector
