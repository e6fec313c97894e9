// SPDX-License-Identifier: Apache-2.0
#include "panvo/panoramic_compass/turn_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "great_circles.hpp"
#include "panvo/vision/angle.hpp"
#include "panvo/vision/median.hpp"
#include "panvo/vision/pose.hpp"
#include "panvo/vision/robust_loss.hpp"

namespace panvo::panoramic_compass {
namespace {

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
constexpr double kMaxNoise = 9.0;        // of the stated variances: points farther off are outliers
constexpr double kTiltSigma_rad = 0.05;  // roll and pitch between two panoramas, road vehicle
constexpr double kSlopeSigma = 0.2;      // vertical component of the drift, road vehicle
constexpr double kMinSpread_rad = 3e-4;
constexpr double kSure_rad =
    0.25 * vision::kDegree;          // of the drift azimuth; between buildings it is smaller, and there is one solution
constexpr double kMoves_rad = 1e-3;  // typical parallax; of less, no direction makes a turn
constexpr int kOthers = 12;          // directions over a full turn from which other motions are sought
constexpr double kAlike = 4.0;       // points whose errors are alike count as one

struct NormalEquations {
  Matrix5d hessian = Matrix5d::Zero();
  Vector5d gradient = Vector5d::Zero();
};

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
      NormalEquations equations;
      cost = accumulate(motion, [&](const Deviation&) -> NormalEquations& { return equations; });
      add_prior(motion, equations);
      const Eigen::LDLT<Matrix5d> solver(equations.hessian);
      if (solver.info() != Eigen::Success || !solver.isPositive()) return std::numeric_limits<double>::infinity();
      Vector5d step = -solver.solve(equations.gradient);
      if (!step.allFinite()) return std::numeric_limits<double>::infinity();
      const double length = step.norm();
      if (length > 0.5) step *= 0.5 / length;
      motion = motion.moved(step);
      hessian_ = equations.hessian;
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

  /// Builds normal equations at the motion of the last gauge(). `equations_of` returns those that a deviation adds to.
  template <class EquationsOf>
  double accumulate(const Motion& motion, const EquationsOf& equations_of) const {
    const vision::CauchyLoss loss(kLossScale);
    const auto tangents = motion.tangents();
    double cost = 0.0;
    const auto add = [&](double residual, double variance, const Vector5d& jacobian, NormalEquations& equations) {
      const double square = residual * residual / variance;
      const double weight = loss.weight(square) / variance;
      cost += loss.cost(square);
      equations.hessian.noalias() += weight * jacobian * jacobian.transpose();
      equations.gradient.noalias() += weight * residual * jacobian;
    };
    for (const Deviation& d : deviations_) {
      Vector5d jacobian = Vector5d::Zero();
      jacobian.head<3>() = d.lever.dot(d.predicted) * motion.drift - motion.drift.dot(d.predicted) * d.lever;
      const Eigen::Vector3d by_drift = d.lever.cross(d.predicted);
      jacobian(3) = by_drift.dot(tangents[0]);
      jacobian(4) = by_drift.dot(tangents[1]);
      add(d.across, noise_ * d.across_variance, jacobian, equations_of(d));
      jacobian.setZero();
      jacobian.head<3>() = -d.normal;
      add(d.along, noise_ * d.along_variance + std::pow(spread_ * d.sine, 2), jacobian, equations_of(d));
    }
    return cost;
  }

  /// Priors for a vehicle on a road.
  void add_prior(const Motion& motion, NormalEquations& equations) const {
    auto& [hessian, gradient] = equations;
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
      return !d || disagreement(*d, kMaxNoise) < kAgreeing;
    });
    return static_cast<double>(agreeing) / static_cast<double>(pairs_.size());
  }

  /// Covariance of rotation and drift for correlated errors of neighbouring points: jackknife, from how much the fit
  /// would change without each sector of the full turn. Few points that decide alone leave small residuals, but show in
  /// this.
  Matrix5d covariance_by_sectors(const Motion& motion) const {
    std::array<NormalEquations, kSectors> sectors;
    accumulate(motion, [&](const Deviation& d) -> NormalEquations& {
      const double turn = std::atan2(d.predicted.y(), d.predicted.x()) / (2.0 * std::numbers::pi) + 0.5;
      return sectors[static_cast<std::size_t>(std::clamp(static_cast<int>(turn * kSectors), 0, kSectors - 1))];
    });
    NormalEquations all;
    add_prior(motion, all);
    for (const auto& sector : sectors) all.hessian += sector.hessian;
    Matrix5d spread = Matrix5d::Zero();
    for (const auto& sector : sectors) {
      const Vector5d change = Matrix5d(all.hessian - sector.hessian).ldlt().solve(sector.gradient);
      spread += change * change.transpose();
    }
    return (kSectors - 1.0) / kSectors * spread;
  }

  /// Mean square differences of yaw and drift azimuth from the other motions that explain the points about as well. In
  /// open land, where all points are near the horizon, a turn looks much like motion in another direction.
  std::pair<double, double> spread_of_others(const Motion& best) {
    std::vector<Motion> motions{best};
    gauge(best);
    double noise = noise_;
    for (int i = 1; i < kOthers; ++i) {
      const Eigen::AngleAxisd turn(2.0 * std::numbers::pi * i / kOthers, Eigen::Vector3d::UnitZ());
      Motion other{best.rotation, turn * best.drift};
      if (!std::isfinite(iterate(other, kTrialIterations))) continue;
      orient(pairs_, other);
      gauge(other);
      noise = std::min(noise, noise_);
      motions.push_back(other);
    }
    const double best_disagreement = total_disagreement(pairs_, best, noise);
    double weights = 0.0, yaw_rad2 = 0.0, drift_azimuth_rad2 = 0.0;
    for (const Motion& motion : motions) {
      const double more = total_disagreement(pairs_, motion, noise) - best_disagreement;
      const double weight = std::exp(-0.5 * std::max(0.0, more) / kAlike);
      weights += weight;
      yaw_rad2 += weight * std::pow(vision::wrapped(yaw_of(motion) - yaw_of(best)), 2);
      drift_azimuth_rad2 += weight * std::pow(vision::wrapped(azimuth_of(motion) - azimuth_of(best)), 2);
    }
    return {yaw_rad2 / weights, drift_azimuth_rad2 / weights};
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
  fit.yaw_rad = yaw_of(best);
  fit.typical_parallax = solver.typical();
  double parallax = 0.0, squared_parallax = 0.0;
  for (const BearingPair& pair : pairs) {
    const auto d = deviation_of(pair, best);
    const double allowed = std::min(solver.noise(), kMaxNoise);
    const bool agrees = !d || disagreement(*d, allowed) < kAgreeing;
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
  if (fit.drift_azimuth_variance_rad2 > kSure_rad * kSure_rad && fit.typical_parallax > kMoves_rad) {
    const auto [yaw_rad2, drift_azimuth_rad2] = solver.spread_of_others(best);
    fit.yaw_variance_rad2 += yaw_rad2;
    fit.drift_azimuth_variance_rad2 += drift_azimuth_rad2;
  }
  return fit;
}

}  // namespace panvo::panoramic_compass
