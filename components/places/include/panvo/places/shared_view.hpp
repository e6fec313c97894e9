// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/places/bearing_pair.hpp"

namespace panvo::places {

/// Parameters of the test whether two panoramas show one place.
struct SharedViewParameters {
  double descriptor_ratio = 0.85;    ///< of the nearest to the second nearest descriptor, at most
  double same_object_deg = 2.0;      ///< matches closer than this in both panoramas are one piece of evidence
  double log10_false_alarms = -3.0;  ///< expected number of places found by chance per query, as power of ten
  double object_deg = 60.0;  ///< width of an object that may stand elsewhere again; the rest must agree without it
  double bearing_sigma_deg = 0.4;  ///< of a keypoint's bearing
};

enum class ViewModel {
  kRotation,    ///< one position: bearings differ by a rotation
  kEqualRange,  ///< other position, things at about one distance
  kEpipolar,    ///< other position, things at any distance
};

/// Rotation and, if the position differs noticeably, direction of travel between two panoramas.
struct SharedView {
  ViewModel model = ViewModel::kRotation;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< place_from_query; X right, Y down, Z forward
  double heading_rad = 0.0;                                ///< yaw at the query minus yaw at the place, left positive
  double heading_sigma_rad = 0.0;
  std::optional<Eigen::Vector3d> direction;  ///< of the query, seen from the place, unit; nullopt: not observable
  double direction_sigma_rad = 0.0;
  double baseline_per_range = 0.0;  ///< distance of the positions over the median distance of the things seen
};

struct SharedViewResult {
  std::optional<SharedView> view;
  int matches = 0;                    ///< of keypoints
  int agreeing = 0;                   ///< with the best motion
  double log10_expected = 0.0;        ///< of the number of equally good agreements by chance
  double log10_without_object = 0.0;  ///< the largest without an object of 60 degrees, or without sky and vehicle
  std::string reason;                 ///< why there is no view; else empty
  std::vector<BearingPair> agreeing_pairs;
};

/// Tests whether two panoramas show one place, by the bearings of their SIFT features alone. `log10_places`: of the
/// number of places that this query is compared with. Deterministic.
SharedViewResult find_shared_view(std::span<const landmarks::Keypoint> query,
                                  std::span<const landmarks::Keypoint> place, double log10_places,
                                  const SharedViewParameters& parameters);

}  // namespace panvo::places
