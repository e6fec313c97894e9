// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "panvo/evaluation/journey_recording.hpp"
#include "panvo/evaluation/journey_run.hpp"

namespace panvo::evaluation {

/// A run, its recording, and the poses of its frames in the world frame of the ground truth.
struct JourneyFrames {
  /// Stamps are in the clock of the ground truth, except those of landmarks, which may come from the earlier journey.
  JourneyRun run;
  const JourneyRecording& recording;
  const JourneyRecording* earlier = nullptr;  ///< recording that built the library, if it is another one
  Eigen::Isometry3d world_from_map = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d world_from_odom = Eigen::Isometry3d::Identity();
};

/// Aligns the starts of both paths with the ground truth. With `earlier`, the origin of the map is the start of that
/// journey. Throws InputError if run and ground truth do not overlap in time.
JourneyFrames journey_frames(const JourneyRun& run, const JourneyRecording& recording, const JourneyRecording* earlier);

enum class RevisitResult {
  kCorrected,    ///< the pose was corrected
  kHeadingOnly,  ///< only the heading was corrected
  kGivenUp,      ///< recognised, but the pose was already more accurate than the correction
  kRejected,     ///< recognised, but the correction was rejected
  kMissed        ///< not recognised
};
std::string_view to_string(RevisitResult result);

/// An applied correction with the errors before and after it. Positions are horizontal, in the world frame of the
/// ground truth.
struct AppliedCorrection {
  std::int64_t stamp_ns = 0;
  std::int64_t landmark = 0;
  double travelled_m = 0.0;
  Eigen::Vector2d before_position_m = Eigen::Vector2d::Zero(), after_position_m = Eigen::Vector2d::Zero();
  double before_m = 0.0, after_m = 0.0;
  double before_heading_rad = 0.0, after_heading_rad = 0.0;  ///< signed, left positive
  std::optional<double> landmark_m;                          ///< error of the landmark's own pose
  /// The error after it exceeds both the previous error and the landmark's own error by more than 1 m.
  bool is_wrong = false;
};

/// A line of Tables 2 and 4 [Lu2015 7.3].
struct Revisit {
  int number = 0;
  std::optional<int> place;  ///< nullopt: a landmark that is not at a listed junction
  std::string name;          ///< of the place
  std::string route;         ///< places passed since the previous pass: "0-5-4-0"
  RevisitResult result = RevisitResult::kMissed;
  std::string reason;         ///< why it was not corrected
  std::int64_t stamp_ns = 0;  ///< of the correction, else of the closest approach
  double travelled_m = 0.0;
  double entrance_rad = 0.0;  ///< heading on entering minus that of the first visit, left positive
  std::optional<std::int64_t> landmark;
  std::optional<std::int64_t> landmark_stamp_ns;  ///< of its panorama; of the first visit if nothing was recognised
  bool landmark_was_earlier = false;              ///< `landmark_stamp_ns` is in the earlier journey
  std::optional<double> heading_rad;              ///< estimated yaw now minus yaw at the landmark
  double true_heading_rad = 0.0;                  ///< true yaw now minus yaw at the landmark
  double distance_m = 0.0;                        ///< true distance between the two viewpoints
  int corrections = 0;                            ///< applied during this visit
  std::optional<double> binocular_m;              ///< 2D errors at `stamp_ns`
  std::optional<double> before_m, after_m;
  std::optional<double> binocular_heading_rad, before_heading_rad, after_heading_rad;
  std::optional<double> landmark_m, landmark_heading_rad;  ///< error of the landmark at its creation
  std::optional<double> beyond_m;                          ///< after_m minus landmark_m
  bool is_wrong = false;
};

struct RevisitScore {
  std::vector<Revisit> revisits;
  std::vector<AppliedCorrection> applied;                                                   ///< all, in order of time
  int listed = 0, corrected = 0, heading_only = 0, given_up = 0, rejected = 0, missed = 0;  ///< of the listed ones
  int elsewhere = 0;     ///< rows of places that are not listed
  int wrong = 0;         ///< wrong corrections
  int not_reached = 0;   ///< listed passes before the start or after the end of the run; they have no rows
  int before_start = 0;  ///< skipped outcomes outside the time span of the ground truth
};

/// With a list of visits: one row per revisit, and one per other place that corrected the pose. Without a list: rows
/// from outcomes.csv.
RevisitScore score_revisits(const JourneyFrames& frames);

}  // namespace panvo::evaluation
