// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "panvo/places/bearing_pair.hpp"
#include "panvo/places/chance.hpp"
#include "panvo/places/shared_view.hpp"

namespace panvo::places {

/// A hypothesis of the motion between two panoramas.
struct ViewMotion {
  ViewModel model = ViewModel::kRotation;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< place_from_query
  /// Of the query in the place's frame. kEqualRange: in units of the common range; kEpipolar: unit.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

/// Sine of the angle from the baseline below which every epipolar plane fits a pair.
inline constexpr double kNearEpipole = 0.04;

/// Whether the thing seen lies ahead along both bearings; true if it is too far to tell.
bool is_ahead(const Eigen::Vector3d& place, const Eigen::Vector3d& turned_query, const Eigen::Vector3d& baseline);

/// Matches that define a motion of this model: of 3, 6 and 5 unknowns, at 2, 2 and 1 equations each.
int sample_size(ViewModel model);

/// Probability by chance that a pair agrees with the motion as well as it does; 1 if it contradicts it.
double probability(const BearingPair& pair, const ViewMotion& motion);

std::vector<double> probabilities(const std::vector<BearingPair>& pairs, const ViewMotion& motion);

/// Quick score of a hypothesis: the sum of the evidence of its agreeing pairs, nats.
double evidence(const std::vector<BearingPair>& pairs, const ViewMotion& motion);

/// Hypotheses for each model, best first, from all pairs. Deterministic.
std::vector<ViewMotion> propose_motions(const std::vector<BearingPair>& pairs);

/// Least-squares motion of the same model over these pairs, from a start. `sigma_rad`: of a bearing; only the epipolar
/// model needs it.
ViewMotion refine_motion(const ViewMotion& start, const std::vector<BearingPair>& pairs, double sigma_rad);

/// Standard deviations of a motion over the pairs that agree with it.
struct MotionUncertainty {
  double heading_rad = 0.0;
  double direction_rad = 0.0;  ///< of the translation, the larger of both axes
};
MotionUncertainty motion_uncertainty(const ViewMotion& motion, const std::vector<BearingPair>& agreeing,
                                     double sigma_rad);

}  // namespace panvo::places
