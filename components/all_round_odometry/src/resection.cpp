// SPDX-License-Identifier: Apache-2.0
#include "panvo/all_round_odometry/resection.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "panvo/vision/robust_loss.hpp"

namespace panvo::all_round_odometry {
namespace {

constexpr int kMaxIterations = 40, kFullSteps = 8;
constexpr double kSettled = 2e-4;   // m and rad: far below the noise
constexpr double kLossScale = 2.0;  // standard deviations
constexpr double kAgrees = 3.0;     // standard deviations
constexpr double kMaxStep = 20.0;   // m: a vehicle between two panoramas
// Deviation from the start: a vehicle between two panoramas.
constexpr double kExpectedWay_m = 0.5, kExpectedTurn_rad = 0.1;
constexpr double kInside = 0.05;  // share of the distance: nearer, a point is inside the camera
// Stitching, lens and changed appearance: 0.15 px of a panorama of 1080 columns.
constexpr double kSystematic_rad = 9e-4;

}  // namespace

std::optional<Residual> residual_of(const Sighting& sighting, double inverse_m,
                                    const Eigen::Isometry3d& then_from_now) {
  const Eigen::Matrix3d now_from_then = then_from_now.linear().transpose();
  const Eigen::Vector3d& position = then_from_now.translation();
  const Eigen::Vector3d ray = now_from_then * (sighting.then - inverse_m * position);
  const double length = ray.norm();
  if (!(length > kInside)) return std::nullopt;
  const Eigen::Vector3d expected = ray / length;

  const Eigen::Vector3d level = Eigen::Vector3d::UnitZ().cross(sighting.now);
  const Eigen::Vector3d azimuth = level.norm() > kInside ? level.normalized() : Eigen::Vector3d::UnitY();
  Eigen::Matrix<double, 2, 3> tangents;
  tangents << azimuth.transpose(), sighting.now.cross(azimuth).transpose();

  const Eigen::Matrix<double, 2, 3> by_ray =
      tangents * (Eigen::Matrix3d::Identity() - expected * expected.transpose()) / length;
  Residual residual;
  residual.error = tangents * expected;
  residual.by_pose << -inverse_m * by_ray * now_from_then,
      tangents * now_from_then * vision::skew(now_from_then.transpose() * expected);
  residual.by_inverse = -by_ray * now_from_then * position;
  residual.measurement_covariance =
      (sighting.variance_rad2 + Eigen::Vector2d::Constant(kSystematic_rad * kSystematic_rad)).asDiagonal();
  return residual;
}

std::optional<Resection> resect(std::span<const KnownSighting> points, const Eigen::Isometry3d& start) {
  const vision::CauchyLoss loss(kLossScale);
  vision::Vector6d expected;
  expected << Eigen::Vector3d::Constant(std::pow(kExpectedWay_m, -2)),
      Eigen::Vector3d::Constant(std::pow(kExpectedTurn_rad, -2));
  const vision::Matrix6d prior = expected.asDiagonal();
  Resection found;
  found.local_from_now = start;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    vision::Matrix6d normal = prior;
    vision::Vector6d gradient = prior * vision::pose_error(start, found.local_from_now);
    double disagreement = 0.0;
    found.agreeing = 0;
    for (const KnownSighting& point : points) {
      const Eigen::Isometry3d& then_from_local = *point.then_from_local;
      const auto residual = residual_of(*point.sighting, point.inverse.mean, then_from_local * found.local_from_now);
      if (!residual) continue;
      Eigen::Matrix<double, 2, 6> by_pose;
      by_pose << residual->by_pose.leftCols<3>() * then_from_local.linear(),
          residual->by_pose.rightCols<3>() * then_from_local.linear();
      const Eigen::Matrix2d weight = (residual->measurement_covariance +
                                      point.inverse.variance * residual->by_inverse * residual->by_inverse.transpose())
                                         .inverse();
      const double squared = residual->error.dot(weight * residual->error);
      const Eigen::Matrix<double, 6, 2> weighted = loss.weight(squared) * by_pose.transpose() * weight;
      normal += weighted * by_pose;
      gradient += weighted * residual->error;
      if (squared > kAgrees * kAgrees) continue;
      ++found.agreeing;
      disagreement += squared;
    }
    const Eigen::LDLT<vision::Matrix6d> solver(normal);
    if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 1e-9 * solver.vectorD().maxCoeff()))
      return std::nullopt;
    // The weights depend on the pose; half steps end a cycle between two.
    const vision::Vector6d step = -(iteration < kFullSteps ? 1.0 : 0.5) * solver.solve(gradient);
    if (!step.allFinite() || step.head<3>().norm() > kMaxStep) return std::nullopt;
    found.local_from_now.translation() += step.head<3>();
    found.local_from_now.linear() =
        vision::nearest_rotation(vision::so3_exp(step.tail<3>()) * found.local_from_now.linear());
    if (step.cwiseAbs().maxCoeff() > kSettled) continue;
    // Where points disagree more than stated, the pose is less certain, too.
    const double excess = disagreement / std::max(1.0, 2.0 * found.agreeing - 6.0);
    found.covariance = std::max(1.0, excess) * solver.solve(vision::Matrix6d::Identity());
    return found;
  }
  return std::nullopt;
}

}  // namespace panvo::all_round_odometry
