// SPDX-License-Identifier: Apache-2.0
#include "panvo/panoramic_compass/turn_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "panvo/vision/median.hpp"
#include "panvo/vision/pose.hpp"
#include "panvo/vision/robust_loss.hpp"

namespace panvo::panoramic_compass {
namespace {

using Vector5d = Eigen::Matrix<double, 5, 1>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;

constexpr int kDirections = 4;       // tried drift directions over half a turn; orient() chooses the sign
constexpr int kTrialIterations = 6;  // enough to rank the trials
constexpr int kMaxIterations = 15;
constexpr double kEnough = 0.8;  // share of points: the rest are individual moving objects
constexpr std::array<double, 4> kOtherStarts_rad{-0.08, -0.04, 0.04, 0.08};
constexpr double kFirstNoise = 1600.0,
                 kNoiseFall = 0.25;  // limit of the noise factor in the first step, and its decrease
constexpr int kSectors = 16;
constexpr double kSettled_rad = 1e-6;
constexpr double kLossScale = 2.0;       // standard deviations
constexpr double kBeside = 0.3;          // sine: ahead and behind, parallax tells no distance
constexpr double kAgrees = 3.0;          // standard deviations
constexpr double kMaxNoise = 9.0;        // of the stated variances: points farther off are outliers
constexpr double kNearPole = 0.05;       // sine: nearer to the drift direction, the great circle is undefined
constexpr double kTiltSigma_rad = 0.05;  // roll and pitch between two panoramas, road vehicle
constexpr double kSlopeSigma = 0.2;      // vertical component of the drift, road vehicle
constexpr double kMinSpread_rad = 3e-4;

/// State of the fit: rotation and drift direction; the latter is parametrised along two tangents.
struct Motion {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d drift;

  std::array<Eigen::Vector3d, 2> tangents() const {
    const Eigen::Vector3d level = Eigen::Vector3d::UnitZ().cross(drift).normalized();
    return {level, drift.cross(level)};
  }
  Motion moved(const Vector5d& step) const {
    const auto [level, upright] = tangents();
    const Eigen::Vector3d turned = drift + step(3) * level + step(4) * upright;
    return {vision::so3_exp(step.head<3>()) * rotation, turned.normalized()};
  }
};

/// Deviation of a point from its great circle.
struct Deviation {
  double across = 0.0, along = 0.0;                    // rad
  double across_variance = 1.0, along_variance = 1.0;  // of the measurement
  double sine = 0.0;                                   // of the angle to the drift direction
  Eigen::Vector3d normal;                              // of the plane of the circle
  Eigen::Vector3d lever;                               // lever arm of the derivatives
  Eigen::Vector3d predicted;                           // position of a far point
};

std::optional<Deviation> deviation_of(const BearingPair& pair, const Motion& motion) {
  Deviation d;
  d.predicted = motion.rotation * pair.then;
  const Eigen::Vector3d cross = d.predicted.cross(motion.drift);
  d.sine = cross.norm();
  if (d.sine < kNearPole) return std::nullopt;
  d.normal = cross / d.sine;
  const double q = pair.now.dot(d.normal);
  d.across = std::asin(std::clamp(q, -1.0, 1.0));
  d.along = std::atan2(pair.now.dot(d.normal.cross(d.predicted)), pair.now.dot(d.predicted));
  d.lever = (pair.now - q * d.normal) / d.sine;
  const Eigen::Vector3d azimuth = Eigen::Vector3d::UnitZ().cross(pair.now).normalized();
  const Eigen::Vector3d elevation = pair.now.cross(azimuth);
  const Eigen::Vector3d forward = d.normal.cross(pair.now);
  const auto variance = [&](const Eigen::Vector3d& direction) {
    return pair.variance_rad2.x() * std::pow(direction.dot(azimuth), 2) +
           pair.variance_rad2.y() * std::pow(direction.dot(elevation), 2);
  };
  d.across_variance = variance(d.normal);
  d.along_variance = variance(forward);
  return d;
}

/// Chooses the sign of the drift so that near points move towards it.
void orient(std::span<const BearingPair> pairs, Motion& motion) {
  double sum = 0.0;
  for (const BearingPair& pair : pairs) {
    const auto d = deviation_of(pair, motion);
    if (d && d->across * d->across < kAgrees * kAgrees * d->across_variance) sum += std::clamp(d->along, -0.1, 0.1);
  }
  if (sum < 0.0) motion.drift = -motion.drift;
}

/// Squared deviation across the great circle or backwards along it, whichever is larger, in standard deviations
/// squared.
double disagreement(const Deviation& d, double noise) {
  const double across = d.across * d.across / (noise * d.across_variance);
  const double behind = d.along < 0.0 ? d.along * d.along / (noise * d.along_variance) : 0.0;
  return std::max(across, behind);
}

/// Truncated sum over all points; unlike the cost of a fit, comparable between motions.
double total_disagreement(std::span<const BearingPair> pairs, const Motion& motion, double noise) {
  double total = 0.0;
  for (const BearingPair& pair : pairs) {
    if (const auto d = deviation_of(pair, motion)) total += std::min(disagreement(*d, noise), kAgrees * kAgrees);
  }
  return total;
}

class Solver {
 public:
  Solver(std::span<const BearingPair> pairs, const Eigen::Matrix3d& start) : pairs_(pairs), start_(start) {}

  /// Gauss-Newton on the robust cost. Returns the cost of the last step, or infinity for a singular system.
  double iterate(Motion& motion, int iterations) {
    double cost = std::numeric_limits<double>::infinity();
    for (int i = 0; i < iterations; ++i) {
      gauge(motion);
      // Initially all residuals may be large; later, large ones are outliers and must not inflate the noise estimate.
      noise_ = std::min(noise_, std::max(kMaxNoise, kFirstNoise * std::pow(kNoiseFall, i)));
      Matrix5d hessian = Matrix5d::Zero();
      Vector5d gradient = Vector5d::Zero();
      cost = accumulate(motion, hessian, [&](const Deviation&) -> Vector5d& { return gradient; });
      add_prior(motion, hessian, gradient);
      const Eigen::LDLT<Matrix5d> solver(hessian);
      if (solver.info() != Eigen::Success || !solver.isPositive()) return std::numeric_limits<double>::infinity();
      Vector5d step = -solver.solve(gradient);
      if (!step.allFinite()) return std::numeric_limits<double>::infinity();
      const double length = step.norm();
      if (length > 0.5) step *= 0.5 / length;
      motion = motion.moved(step);
      hessian_ = hessian;
      if (length < kSettled_rad) break;
    }
    return cost;
  }

  /// Computes the deviations of all points, their noise factor relative to the stated variances, and the typical
  /// parallax.
  void gauge(const Motion& motion) {
    deviations_.clear();
    std::vector<double> across, parallax;
    for (const BearingPair& pair : pairs_) {
      const auto d = deviation_of(pair, motion);
      if (!d) continue;
      deviations_.push_back(*d);
      across.push_back(d->across * d->across / d->across_variance);
      if (d->sine > kBeside) parallax.push_back(std::abs(d->along) / d->sine);
    }
    // 0.455: median of a squared standard normal variable
    noise_ = across.empty() ? 1.0 : std::max(1.0, vision::median(across) / 0.455);
    typical_ = parallax.empty() ? 0.0 : vision::median(parallax);
    spread_ = std::max(kMinSpread_rad, 3.0 * typical_);
  }

  /// Builds the normal equations at the motion of the last gauge(). `gradient_of` returns the gradient that a deviation
  /// adds to.
  template <class GradientOf>
  double accumulate(const Motion& motion, Matrix5d& hessian, const GradientOf& gradient_of) const {
    const vision::CauchyLoss loss(kLossScale);
    const auto tangents = motion.tangents();
    double cost = 0.0;
    const auto add = [&](double residual, double variance, const Vector5d& jacobian, Vector5d& gradient) {
      const double square = residual * residual / variance;
      const double weight = loss.weight(square) / variance;
      cost += loss.cost(square);
      hessian.noalias() += weight * jacobian * jacobian.transpose();
      gradient.noalias() += weight * residual * jacobian;
    };
    for (const Deviation& d : deviations_) {
      Vector5d jacobian = Vector5d::Zero();
      jacobian.head<3>() = d.lever.dot(d.predicted) * motion.drift - motion.drift.dot(d.predicted) * d.lever;
      const Eigen::Vector3d by_drift = d.lever.cross(d.predicted);
      jacobian(3) = by_drift.dot(tangents[0]);
      jacobian(4) = by_drift.dot(tangents[1]);
      add(d.across, noise_ * d.across_variance, jacobian, gradient_of(d));
      jacobian.setZero();
      jacobian.head<3>() = -d.normal;
      add(d.along, noise_ * d.along_variance + std::pow(spread_ * d.sine, 2), jacobian, gradient_of(d));
    }
    return cost;
  }

  /// Priors for a vehicle on a road.
  void add_prior(const Motion& motion, Matrix5d& hessian, Vector5d& gradient) const {
    const Eigen::Vector3d tilt = vision::so3_log(motion.rotation * start_.transpose());
    for (int axis = 0; axis < 2; ++axis) {
      hessian(axis, axis) += 1.0 / (kTiltSigma_rad * kTiltSigma_rad);
      gradient(axis) += tilt(axis) / (kTiltSigma_rad * kTiltSigma_rad);
    }
    hessian(3, 3) += 1.0;  // keeps the direction at standstill
    hessian(4, 4) += 1.0 / (kSlopeSigma * kSlopeSigma);
    gradient(4) += motion.drift.z() * motion.tangents()[1].z() / (kSlopeSigma * kSlopeSigma);
  }

  /// Best of several short fits, from each start rotation with several drift directions.
  Motion search(const std::vector<Eigen::Matrix3d>& starts) {
    std::vector<Motion> trials;
    double noise = kMaxNoise;
    for (const Eigen::Matrix3d& rotation : starts) {
      for (int i = 0; i < kDirections; ++i) {
        const double azimuth = i * std::numbers::pi / kDirections;
        Motion trial{rotation, {-std::cos(azimuth), -std::sin(azimuth), 0.0}};
        if (!std::isfinite(iterate(trial, kTrialIterations))) continue;
        orient(pairs_, trial);
        gauge(trial);
        noise = std::min(noise, noise_);
        trials.push_back(trial);
      }
    }
    if (trials.empty()) return {starts.front(), -Eigen::Vector3d::UnitX()};
    return *std::min_element(trials.begin(), trials.end(), [&](const Motion& a, const Motion& b) {
      return total_disagreement(pairs_, a, noise) < total_disagreement(pairs_, b, noise);
    });
  }

  /// Short fit from the given motion; true if enough points agree, the usual case.
  bool settles(Motion& motion) {
    if (!std::isfinite(iterate(motion, kTrialIterations))) return false;
    orient(pairs_, motion);
    gauge(motion);
    return noise_ < kMaxNoise && share_that_agrees(motion) >= kEnough;
  }

  double share_that_agrees(const Motion& motion) const {
    const auto agreeing = std::count_if(pairs_.begin(), pairs_.end(), [&](const BearingPair& pair) {
      const auto d = deviation_of(pair, motion);
      return !d || disagreement(*d, kMaxNoise) < kAgrees * kAgrees;
    });
    return static_cast<double>(agreeing) / static_cast<double>(pairs_.size());
  }

  /// Covariance of rotation and drift for correlated errors of neighbouring points: sandwich estimate from the
  /// gradients of the sectors of the full turn.
  Matrix5d covariance_by_sectors(const Motion& motion) const {
    std::array<Vector5d, kSectors> pulls;
    pulls.fill(Vector5d::Zero());
    Matrix5d hessian = Matrix5d::Zero();
    accumulate(motion, hessian, [&](const Deviation& d) -> Vector5d& {
      const double turn = std::atan2(d.predicted.y(), d.predicted.x()) / (2.0 * std::numbers::pi) + 0.5;
      return pulls[static_cast<std::size_t>(std::clamp(static_cast<int>(turn * kSectors), 0, kSectors - 1))];
    });
    Matrix5d spread = Matrix5d::Zero();
    for (const Vector5d& pull : pulls) spread += pull * pull.transpose();
    const Matrix5d inverse = hessian.inverse();
    return kSectors / (kSectors - 3.0) * inverse * spread * inverse;
  }

  double noise() const { return noise_; }
  double spread() const { return spread_; }
  double typical() const { return typical_; }
  const Matrix5d& hessian() const { return hessian_; }

 private:
  std::span<const BearingPair> pairs_;
  Eigen::Matrix3d start_;
  std::vector<Deviation> deviations_;
  Matrix5d hessian_ = Matrix5d::Identity();
  double noise_ = 1.0, spread_ = 1.0, typical_ = 0.0;
};

}  // namespace

std::optional<TurnFit> fit_turn(std::span<const BearingPair> pairs, const Eigen::Matrix3d& start_now_from_then,
                                const Eigen::Vector3d& start_drift) {
  if (pairs.size() < 6) return std::nullopt;
  Solver solver(pairs, start_now_from_then);
  Motion best{start_now_from_then, start_drift.normalized()};
  if (!solver.settles(best)) best = solver.search({start_now_from_then});
  if (solver.share_that_agrees(best) < kEnough) {  // a large moving object may have biased the start
    std::vector<Eigen::Matrix3d> starts;
    for (const double offset_rad : kOtherStarts_rad) {
      starts.push_back(vision::so3_exp({0.0, 0.0, offset_rad}) * start_now_from_then);
    }
    const Motion other = solver.search(starts);
    if (solver.share_that_agrees(other) > solver.share_that_agrees(best)) best = other;
  }
  if (!std::isfinite(solver.iterate(best, kMaxIterations))) return std::nullopt;
  orient(pairs, best);
  solver.gauge(best);

  TurnFit fit;
  fit.now_from_then = best.rotation;
  fit.drift = best.drift;
  fit.yaw_rad = std::atan2(best.rotation(0, 1), best.rotation(0, 0));
  fit.typical_parallax = solver.typical();
  double parallax = 0.0, squared_parallax = 0.0;
  for (const BearingPair& pair : pairs) {
    const auto d = deviation_of(pair, best);
    const double allowed = std::min(solver.noise(), kMaxNoise);
    const bool agrees = !d || disagreement(*d, allowed) < kAgrees * kAgrees;
    fit.agrees.push_back(agrees);
    fit.agreeing += agrees ? 1 : 0;
    if (!d || !agrees || d->sine < kBeside) continue;
    parallax += std::abs(d->along) / d->sine;
    squared_parallax += std::pow(d->along / d->sine, 2);
  }
  if (parallax > 0.0) fit.near_parallax = 0.5 * squared_parallax / parallax;
  const Matrix5d by_points = solver.hessian().inverse(), by_sectors = solver.covariance_by_sectors(best);
  const auto variance_of = [&](Eigen::Index i) {
    return std::max(by_points(i, i), 0.5 * (by_points(i, i) + by_sectors(i, i)));
  };
  fit.yaw_variance_rad2 = variance_of(2);
  fit.drift_azimuth_variance_rad2 = variance_of(3);
  return fit;
}

}  // namespace panvo::panoramic_compass
