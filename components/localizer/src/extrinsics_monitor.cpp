// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/extrinsics_monitor.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace panvo::localizer {
namespace {

constexpr double kMinStep_m = 0.3;   // between two compared sightings
constexpr double kMaxGap_m = 5.0;    // within a pass
constexpr double kMaxPass_m = 40.0;  // beyond, odometry drift reaches the size of the effect

// Sightings with a larger deviation than a camera rotated by a dozen degrees would cause are ignored.
constexpr double kMaxTurned = 0.25;
constexpr double kMaxOffset_m = 1.0;

constexpr double kOdometry_m = 0.02;  // over a few metres
// The sightings of a pass share points and hence errors: three count as one. With this factor the estimates for
// correctly mounted cameras scatter according to their standard deviations.
constexpr double kAlike = 3.0;
constexpr double kSureSigmas = 3.0;
// Precise enough that a single pass with a bad landmark does not decide.
constexpr double kWellKnown = 0.5;
// Prior: any camera is within a metre and half a turn.
const Eigen::Vector4d kPriorSigma(3.0, 3.0, 1.0, 1.0);

/// Weight of a sighting's position, 1/m^2.
double weight_of(const LandmarkSighting& sighting) {
  const double variance = sighting.covariance.topLeftCorner<2, 2>().trace() / 2.0;
  return 1.0 / (kAlike * (variance + kOdometry_m * kOdometry_m));
}

double way_between(const OdometrySample& a, const OdometrySample& b) { return std::abs(b.way_m - a.way_m); }

Eigen::Isometry3d step_between(const OdometrySample& a, const OdometrySample& b) {
  return a.pose.odom_from_base.inverse() * b.pose.odom_from_base;
}

}  // namespace

void ExtrinsicsMonitor::add(const LandmarkSighting& sighting, const OdometrySample& at) {
  if (!continues_pass(sighting, at)) {
    ended_passes_ = with_current_pass();
    Pass begun;
    begun.first = sighting;
    begun.first_at = begun.last_at = at;
    begun.weight = weight_of(sighting);  // its own difference is zero
    pass_ = begun;
    return;
  }
  if (way_between(pass_->last_at, at) < kMinStep_m) return;
  pass_->last_at = at;
  const Eigen::Isometry3d by_odometry = step_between(pass_->first_at, at);
  const Eigen::Vector3d way = by_odometry.translation();
  const Eigen::Vector3d by_panoramas =
      pass_->first.landmark_from_base.inverse() * sighting.landmark_from_base.translation();
  const Eigen::Vector3d difference = by_panoramas - way;
  if (difference.norm() > kMaxOffset_m + kMaxTurned * way.norm()) return;
  // The panoramas measure a base_link displaced by t and rotated by w relative to the true one:
  // path seen = path + path x w + (turn - 1) t.
  Matrix34d jacobian;
  jacobian.col(0) = way.cross(Eigen::Vector3d::UnitZ());
  jacobian.col(1) = way.cross(Eigen::Vector3d::UnitY());
  jacobian.rightCols<2>() = (by_odometry.linear() - Eigen::Matrix3d::Identity()).leftCols<2>();
  const double weight = weight_of(sighting);
  pass_->weight += weight;
  pass_->jtj += weight * jacobian.transpose() * jacobian;
  pass_->jtd += weight * jacobian.transpose() * difference;
  pass_->j += weight * jacobian;
  pass_->d += weight * difference;
}

std::optional<ExtrinsicsMonitor::Misalignment> ExtrinsicsMonitor::misalignment() const {
  const auto equations = with_current_pass();
  const Matrix4d prior = kPriorSigma.cwiseAbs2().cwiseInverse().asDiagonal();
  const Matrix4d covariance = (equations.left + prior).inverse();
  const Eigen::Vector4d found = covariance * equations.right;
  const auto is_notable = [&](Eigen::Index first, double notable) {
    const Eigen::Vector2d size = found.segment<2>(first);
    const Eigen::Matrix2d spread = covariance.block<2, 2>(first, first);
    const double min_known = std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvalues()(1));
    return size.norm() > notable && min_known < kWellKnown * notable &&
           size.dot(spread.ldlt().solve(size)) > kSureSigmas * kSureSigmas;
  };
  Misalignment misalignment{found(0), found(1), found(2), found(3)};
  misalignment.is_turned = is_notable(0, kNotable_rad);
  misalignment.is_displaced = is_notable(2, kNotable_m);
  if (!misalignment.is_turned && !misalignment.is_displaced) return std::nullopt;
  return misalignment;
}

bool ExtrinsicsMonitor::continues_pass(const LandmarkSighting& sighting, const OdometrySample& at) const {
  return pass_ && pass_->first.landmark_id == sighting.landmark_id && way_between(pass_->last_at, at) < kMaxGap_m &&
         way_between(pass_->first_at, at) < kMaxPass_m;
}

/// Sum over all passes, eliminating for each the common error of its first sighting.
ExtrinsicsMonitor::NormalEquations ExtrinsicsMonitor::with_current_pass() const {
  NormalEquations all = ended_passes_;
  if (!pass_) return all;
  all.left += pass_->jtj - pass_->j.transpose() * pass_->j / pass_->weight;
  all.right += pass_->jtd - pass_->j.transpose() * pass_->d / pass_->weight;
  return all;
}

}  // namespace panvo::localizer
