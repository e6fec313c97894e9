// SPDX-License-Identifier: Apache-2.0
#include "panvo/panorama_stitcher/gain_compensator.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace panvo::panorama_stitcher {
namespace {

constexpr std::int64_t kMinSamples = 20;
constexpr double kPrior = 1e-6;  // prior for a gain of 1, for gains that the overlaps do not determine

}  // namespace

double GainCompensator::gain(std::size_t head) const { return std::exp(log_gains_.at(head)); }

void GainCompensator::update(const std::vector<Overlap>& overlaps) {
  const auto count = static_cast<Eigen::Index>(log_gains_.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  double weights = 0.0;
  for (const auto& overlap : overlaps) {
    if (overlap.samples < kMinSamples || !(overlap.first_sum > 0.0 && overlap.second_sum > 0.0)) continue;
    const auto weight = static_cast<double>(overlap.samples);
    const auto i = static_cast<Eigen::Index>(overlap.first);
    const auto j = static_cast<Eigen::Index>(overlap.second);
    const double log_ratio = std::log(overlap.second_sum / overlap.first_sum);  // log gain i - log gain j
    normal(i, i) += weight;
    normal(j, j) += weight;
    normal(i, j) -= weight;
    normal(j, i) -= weight;
    right(i) += weight * log_ratio;
    right(j) -= weight * log_ratio;
    weights += weight;
  }
  if (weights == 0.0) return;
  normal.diagonal().array() += kPrior * weights;
  const Eigen::VectorXd wanted = normal.ldlt().solve(right);
  const double limit = std::log(settings_.limit);
  for (std::size_t head = 0; head < log_gains_.size(); ++head) {
    const double target = std::clamp(wanted(static_cast<Eigen::Index>(head)), -limit, limit);
    log_gains_[head] += settings_.rate * (target - log_gains_[head]);
  }
}

}  // namespace panvo::panorama_stitcher
