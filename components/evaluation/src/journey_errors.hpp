// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "panvo/evaluation/journey_recording.hpp"
#include "panvo/evaluation/journey_revisits.hpp"

namespace panvo::evaluation {

/// Horizontal error of one pose.
struct FlatError {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< of the estimate, in the world frame of the ground truth
  double flat_m = 0.0;
  double heading_rad = 0.0;  ///< estimate minus truth, left positive, (-pi, pi]
};

/// Stamp and error of a landmark.
struct LandmarkTruth {
  std::int64_t stamp_ns = 0;  ///< in the clock of the ground truth
  bool was_earlier = false;   ///< it comes from the library
  std::optional<FlatError> error;
};

/// Errors of single poses of a journey; nullopt if ground truth or estimate does not cover the stamp.
class JourneyErrors {
 public:
  explicit JourneyErrors(const JourneyFrames& frames);

  std::optional<Eigen::Isometry3d> truth(std::int64_t stamp_ns, bool earlier = false) const;
  bool has_truth(std::int64_t stamp_ns) const { return path_.pose(stamp_ns).has_value(); }  ///< of the journey
  double travelled_m(std::int64_t stamp_ns) const { return path_.travelled_m(stamp_ns); }

  std::optional<FlatError> of_map(const Eigen::Isometry3d& map_from_base, std::int64_t stamp_ns) const;
  /// If the clocks of both journeys overlap, the landmark is assigned to the journey whose vehicle was nearer at its
  /// stamp.
  LandmarkTruth landmark(const RunLandmark& landmark) const;
  std::optional<FlatError> of_binocular(std::int64_t stamp_ns) const;
  std::optional<FlatError> of_enhanced(std::int64_t stamp_ns) const;

 private:
  const JourneyFrames& frames_;
  TruePath path_, binocular_, enhanced_;
  std::optional<TruePath> earlier_;
};

}  // namespace panvo::evaluation
