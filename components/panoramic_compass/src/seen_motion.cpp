// SPDX-License-Identifier: Apache-2.0
#include "seen_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "panvo/vision/angle.hpp"
#include "panvo/vision/median.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::panoramic_compass {
namespace {

constexpr std::size_t kMinBeside = 10;   // points on each side
constexpr double kSideSector_rad = 0.6;  // on each side of the lateral direction
constexpr double kTurnCaution = 4.0;     // of the turn's variance: in open land it errs by up to twice what it says

}  // namespace

double motion_azimuth_variance(const TurnFit& fit, double turn_variance_rad2) {
  const double parallax = std::max(fit.typical_parallax, fit.near_parallax);
  const double by_turn_rad2 = kTurnCaution * turn_variance_rad2;
  return fit.drift_azimuth_variance_rad2 + by_turn_rad2 / std::max(parallax * parallax, by_turn_rad2);
}

double side_parallax(const std::vector<BearingPair>& pairs, const TurnFit& fit) {
  std::vector<double> left, right;
  double moved_rad = 0.0, squared = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Vector3d far = fit.now_from_then * pairs[i].then;
    const double by_rad = far.cross(pairs[i].now).norm();
    moved_rad += by_rad;
    squared += by_rad * by_rad;
    if (!fit.agrees[i]) continue;
    const double azimuth = std::atan2(far.y(), far.x());
    const double moved = vision::wrapped(std::atan2(pairs[i].now.y(), pairs[i].now.x()) - azimuth);
    if (std::abs(std::abs(azimuth) - 0.5 * std::numbers::pi) > kSideSector_rad) continue;
    if (azimuth > 0.0) left.push_back(moved);
    if (azimuth < 0.0) right.push_back(-moved);
  }
  double beside = 0.0;
  if (!left.empty() && !right.empty()) beside = 0.5 * (vision::median(left) + vision::median(right));
  if (left.empty() != right.empty()) beside = vision::median(left.empty() ? right : left);
  if (std::min(left.size(), right.size()) >= kMinBeside || moved_rad == 0.0) return beside;
  const double near = 0.5 * squared / moved_rad;
  return std::abs(beside) > near ? beside : std::copysign(near, -fit.drift.x());
}

}  // namespace panvo::panoramic_compass
