// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/consistency.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <vector>

#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/statistics.hpp"
#include "text_file.hpp"

namespace panvo::evaluation {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr std::size_t kColumns = 1 + 36 + 36 + 6;

Matrix6d matrix_at(const Fields& fields, std::size_t first) {
  Matrix6d matrix;
  for (std::size_t i = 0; i < 36; ++i) {
    matrix(static_cast<int>(i / 6), static_cast<int>(i % 6)) = fields.number(first + i);
  }
  return matrix;
}

template <int Size>
std::optional<double> squared_error(const Eigen::Matrix<double, Size, 1>& error,
                                    const Eigen::Matrix<double, Size, Size>& covariance) {
  const Eigen::LLT<Eigen::Matrix<double, Size, Size>> factor(covariance);
  if (factor.info() != Eigen::Success) return std::nullopt;
  const double value = error.dot(factor.solve(error));
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

// Transforms a small error (translation, rotation vector) from the start of the motion D to its end: D^-1 exp(e) D.
Matrix6d adjoint_of_inverse(const Eigen::Isometry3d& motion) {
  const Eigen::Matrix3d end_from_start = motion.linear().transpose();
  Matrix6d adjoint = Matrix6d::Zero();
  adjoint.topLeftCorner<3, 3>() = end_from_start;
  adjoint.topRightCorner<3, 3>() = -end_from_start * cross_matrix(motion.translation());
  adjoint.bottomRightCorner<3, 3>() = end_from_start;
  return adjoint;
}

// Covariance of the motion from pairs[first] to pairs[last], in the axes of base_link at its end.
std::optional<Matrix6d> motion_covariance(std::span<const PosePair> pairs, std::size_t first, std::size_t last,
                                          const MotionCovariances& covariances, const Matrix6d& truth_noise) {
  Matrix6d sum = truth_noise;
  for (std::size_t i = first + 1; i <= last; ++i) {
    const auto line = covariances.find(pairs[i].stamp_ns);
    // The twist covers the motion since the estimate's previous pose, so that pose must be among the pairs.
    if (line == covariances.end() || pairs[i].estimate_index != pairs[i - 1].estimate_index + 1) return std::nullopt;
    const Matrix6d& twist = line->second.twist;
    if (twist.llt().info() != Eigen::Success) return std::nullopt;
    const double dt_s = static_cast<double>(pairs[i].stamp_ns - pairs[i - 1].stamp_ns) * 1e-9;
    const Matrix6d adjoint = adjoint_of_inverse(pairs[i - 1].odom_from_base.inverse() * pairs[i].odom_from_base);
    sum = (adjoint * sum * adjoint.transpose() + twist * (dt_s * dt_s)).eval();
  }
  return sum + truth_noise;
}

Vector6d motion_error(const PosePair& from, const PosePair& to) {
  const Eigen::Isometry3d truth = from.map_from_base.inverse() * to.map_from_base;
  const Eigen::Isometry3d estimate = from.odom_from_base.inverse() * to.odom_from_base;
  const Eigen::Isometry3d error = truth.inverse() * estimate;
  Vector6d result;
  result << error.translation(), rotation_vector(error.linear());
  return result;
}

// In the axes of odom, like the pose covariance of nav_msgs/Odometry.
Vector6d accumulated_error(const Eigen::Isometry3d& odom_from_map, const PosePair& pair) {
  const Eigen::Isometry3d truth = odom_from_map * pair.map_from_base;
  Vector6d result;
  result << pair.odom_from_base.translation() - truth.translation(),
      rotation_vector(pair.odom_from_base.linear() * truth.linear().transpose());
  return result;
}

Nees summarize_nees(int dimension, const std::vector<double>& values, bool independent) {
  Nees nees;
  nees.dimension = dimension;
  nees.samples = values.size();
  const double single_bound = chi_square_quantile(dimension, 0.95);
  std::size_t inside = 0;
  for (const double value : values) {
    nees.mean += value / static_cast<double>(values.size());
    inside += value <= single_bound ? 1 : 0;
  }
  nees.inside_95 = static_cast<double>(inside) / static_cast<double>(values.size());
  const double samples = independent ? static_cast<double>(values.size()) : 1.0;
  nees.lower_95 = chi_square_quantile(samples * dimension, 0.025) / samples;
  nees.upper_95 = chi_square_quantile(samples * dimension, 0.975) / samples;
  return nees;
}

}  // namespace

MotionCovariances read_motion_covariances(const std::filesystem::path& file) {
  std::vector<Line> lines = read_lines(file);
  if (lines.front().text.starts_with("stamp_ns")) lines.erase(lines.begin());
  MotionCovariances covariances;
  for (const Line& line : lines) {
    const Fields fields(file, line, ',');
    fields.expect(kColumns, false, "stamp_ns, p00..p55, t00..t55, vx,vy,vz,wx,wy,wz");
    if (!covariances.emplace(fields.integer(0), MotionCovariance{matrix_at(fields, 1), matrix_at(fields, 37)}).second) {
      fields.fail("the stamp " + std::to_string(fields.integer(0)) + " occurs twice", "remove repeated lines");
    }
  }
  return covariances;
}

std::optional<Consistency> consistency(std::span<const PosePair> pairs, const MotionCovariances& covariances,
                                       const ConsistencyOptions& options) {
  const std::size_t steps = options.steps;
  if (steps == 0) throw InputError("NEES over 0 steps; give 1 or more");
  Consistency result;
  result.options = options;
  Matrix6d truth_noise = Matrix6d::Zero();
  truth_noise.diagonal().head<3>().setConstant(options.truth_noise_m * options.truth_noise_m);
  truth_noise.diagonal().tail<3>().setConstant(options.truth_noise_rad * options.truth_noise_rad);
  std::vector<double> full;
  std::vector<double> translation;
  std::vector<double> rotation;
  for (std::size_t last = steps; last < pairs.size(); last += steps) {
    const auto covariance = motion_covariance(pairs, last - steps, last, covariances, truth_noise);
    const Vector6d error = motion_error(pairs[last - steps], pairs[last]);
    const auto value = covariance ? squared_error<6>(error, *covariance) : std::nullopt;
    const auto moved = covariance ? squared_error<3>(error.head<3>(), covariance->topLeftCorner<3, 3>()) : std::nullopt;
    const auto turned =
        covariance ? squared_error<3>(error.tail<3>(), covariance->bottomRightCorner<3, 3>()) : std::nullopt;
    if (!value || !moved || !turned) {
      ++result.unusable;
      continue;
    }
    full.push_back(*value);
    translation.push_back(*moved);
    rotation.push_back(*turned);
  }
  if (full.empty()) return std::nullopt;
  result.motion = summarize_nees(6, full, true);
  result.motion_translation = summarize_nees(3, translation, true);
  result.motion_rotation = summarize_nees(3, rotation, true);

  const Eigen::Isometry3d odom_from_map = pairs.front().odom_from_base * pairs.front().map_from_base.inverse();
  std::vector<double> accumulated;
  for (const PosePair& pair : pairs.subspan(1)) {
    const auto line = covariances.find(pair.stamp_ns);
    if (line == covariances.end()) continue;
    if (const auto value =
            squared_error<6>(accumulated_error(odom_from_map, pair), line->second.pose + 2.0 * truth_noise)) {
      accumulated.push_back(*value);
    }
  }
  if (!accumulated.empty()) result.pose = summarize_nees(6, accumulated, false);
  return result;
}

std::optional<PoseConsistency> pose_consistency(std::span<const PosePair> pairs, const MotionCovariances& covariances,
                                                const Eigen::Isometry3d& truth_from_estimate) {
  constexpr std::array kPlane{0, 1, 5};
  const Eigen::Isometry3d estimate_from_truth = truth_from_estimate.inverse();
  PoseConsistency result;
  std::vector<double> full;
  std::vector<double> plane;
  for (const PosePair& pair : pairs) {
    const auto line = covariances.find(pair.stamp_ns);
    const Vector6d error = accumulated_error(estimate_from_truth, pair);
    const auto value = line == covariances.end() ? std::nullopt : squared_error<6>(error, line->second.pose);
    const auto flat =
        line == covariances.end() ? std::nullopt : squared_error<3>(error(kPlane), line->second.pose(kPlane, kPlane));
    if (value) full.push_back(*value);
    if (flat) plane.push_back(*flat);
    if (!flat) ++result.unusable;
  }
  if (plane.empty()) return std::nullopt;
  if (!full.empty()) result.full = summarize_nees(6, full, false);
  result.plane = summarize_nees(3, plane, false);
  return result;
}

}  // namespace panvo::evaluation
