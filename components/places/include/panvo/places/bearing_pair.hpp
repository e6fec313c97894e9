// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <span>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/position_corrector/epipolar_refinement.hpp"

namespace panvo::places {

/// A pair (`landmark`: bearing from the place, `panorama`: from the query) is the same thing seen from two positions.
using position_corrector::BearingPair;

/// Mutual nearest SIFT matches that pass the ratio test, most similar first. Of matches that are close together in both
/// panoramas only the most similar one is kept: they show one object, hence are one piece of evidence.
std::vector<BearingPair> pair_bearings(std::span<const landmarks::Keypoint> query,
                                       std::span<const landmarks::Keypoint> place, double descriptor_ratio,
                                       double same_object_deg);

/// Clockwise from straight ahead, rad.
inline double azimuth_of(const Eigen::Vector3d& bearing) { return std::atan2(bearing.x(), bearing.z()); }

/// How well pairs fit a motion, as probabilities by chance. A wrong match joins things that look alike, and these
/// often are at one height: lamps, treetops, tiles. So chance is modelled as a query bearing at its own elevation and a
/// random azimuth, not anywhere on the sphere.
double probability_at_angle(const Eigen::Vector3d& query, const Eigen::Vector3d& expected);
/// As above, for the distance of the query bearing from a plane through the camera with this unit normal.
double probability_at_plane(const Eigen::Vector3d& query, const Eigen::Vector3d& normal);

}  // namespace panvo::places
