// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "panvo/evaluation/journey_recording.hpp"
#include "panvo/evaluation/journey_revisits.hpp"

namespace panvo::evaluation {

/// Of one pose, in the plane.
struct FlatError {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< of the estimate, world of the truth
  double flat_m = 0.0;
  double heading_rad = 0.0;  ///< estimate minus truth, left positive, (-pi, pi]
};

/// A landmark and where its panorama was truly taken.
struct LandmarkTruth {
  std::int64_t stamp_ns = 0;  ///< in the clock of the truth
  bool was_earlier = false;   ///< it comes from the library
  std::optional<FlatError> error;
};

/// Errors of single poses of a journey. nullopt where truth or estimate has nothing at that time.
class JourneyErrors {
 public:
  explicit JourneyErrors(const JourneyFrames& frames);

  std::optional<Eigen::Isometry3d> truth(std::int64_t stamp_ns, bool earlier = false) const;
  bool has_truth(std::int64_t stamp_ns) const { return path_.pose(stamp_ns).has_value(); }  ///< of the journey
  double travelled_m(std::int64_t stamp_ns) const { return path_.travelled_m(stamp_ns); }

  std::optional<FlatError> of_map(const Eigen::Isometry3d& map_from_base, std::int64_t stamp_ns) const;
  /// Of two journeys whose clocks overlap, the landmark belongs to the one whose vehicle was nearer to it at its stamp.
  LandmarkTruth landmark(const RunLandmark& landmark) const;
  std::optional<FlatError> of_binocular(std::int64_t stamp_ns) const;
  std::optional<FlatError> of_enhanced(std::int64_t stamp_ns) const;

 private:
  const JourneyFrames& frames_;
  TruePath path_, binocular_, enhanced_;
  std::optional<TruePath> earlier_;
};

}  // namespace panvo::evaluation
