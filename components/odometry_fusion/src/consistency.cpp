// SPDX-License-Identifier: Apache-2.0
#include "panvo/odometry_fusion/consistency.hpp"

#include <algorithm>
#include <cmath>

namespace panvo::odometry_fusion {
namespace {

constexpr double kMemory_s = 1.0;
constexpr double kPatience_s = 5.0;  // half of it contradicted: faulty

/// Value that chi-square with `dof` degrees of freedom exceeds as rarely as a normal variable `sigmas`, after Wilson
/// and Hilferty.
double gate(double dof, double sigmas) {
  const double spread = 2.0 / (9.0 * dof);
  return dof * std::pow(1.0 - spread + sigmas * std::sqrt(spread), 3);
}

}  // namespace

bool is_within(const Innovation& innovation, double gate_sigmas) {
  return innovation.chi_square < gate(static_cast<double>(innovation.residual.size()), gate_sigmas);
}

bool Consistency::add(const Innovation& innovation, double dt_s, double gate_sigmas) {
  const auto size = innovation.residual.size();
  if (residual_.size() != size) {
    residual_ = noise_variance_ = systematic_sigma_ = Vector::Zero(size);
  }
  const double kept = std::exp(-dt_s / kMemory_s);
  const bool is_plausible = is_within(innovation, gate_sigmas);
  residual_ *= kept;
  if (is_plausible) residual_ += innovation.residual;  // others are not used, so do not add up
  noise_variance_ = kept * kept * noise_variance_ + innovation.noise_variance;
  systematic_sigma_ = kept * systematic_sigma_ + innovation.systematic_variance.cwiseSqrt();
  const Vector limit = gate_sigmas * (noise_variance_ + systematic_sigma_.cwiseAbs2()).cwiseSqrt();
  const bool agrees = is_plausible && (residual_.cwiseAbs().array() < limit.array()).all();
  contradicted_ += std::min(1.0, dt_s / kPatience_s) * ((agrees ? 0.0 : 1.0) - contradicted_);
  return agrees;
}

}  // namespace panvo::odometry_fusion
