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

/// A run, what is true of it, and how its frames lie in the world of the truth.
struct JourneyFrames {
  /// All of its stamps in the clock of the truth, but those of landmarks, which may come from the earlier journey.
  JourneyRun run;
  const JourneyRecording& recording;
  const JourneyRecording* earlier = nullptr;  ///< the one that the library was made on, if that was another
  Eigen::Isometry3d world_from_map = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d world_from_odom = Eigen::Isometry3d::Identity();
};

/// Both paths begin where the vehicle truly stood: what a user sees. With `earlier` the map is where that journey began. Throws
/// InputError where run and truth have no time in common.
JourneyFrames journey_frames(const JourneyRun& run, const JourneyRecording& recording, const JourneyRecording* earlier);

enum class RevisitResult {
  kCorrected,    ///< the pose was moved
  kHeadingOnly,  ///< the heading was
  kGivenUp,      ///< the place was found, but the pose was known better
  kRejected,     ///< the place was found, but the correction was not believed
  kMissed        ///< the place was not found
};
std::string_view to_string(RevisitResult result);

/// A correction that was applied, and what it did to the error. Positions are horizontal, in the truth's world.
struct AppliedCorrection {
  std::int64_t stamp_ns = 0;
  std::int64_t landmark = 0;
  double travelled_m = 0.0;
  Eigen::Vector2d before_position_m = Eigen::Vector2d::Zero(), after_position_m = Eigen::Vector2d::Zero();
  double before_m = 0.0, after_m = 0.0;
  double before_heading_rad = 0.0, after_heading_rad = 0.0;  ///< signed, left positive
  std::optional<double> landmark_m;                          ///< error of the landmark's own pose
  /// Away from the truth by more than 1 m beyond what the landmark's own error explains.
  bool is_wrong = false;
};

/// A line of Tables 2 and 4 [Lu2015 7.3].
struct Revisit {
  int number = 0;
  std::optional<int> place;  ///< nullopt: a landmark that no listed crossing belongs to
  std::string name;          ///< the place's
  std::string route;         ///< places passed since it was passed before: "0-5-4-0"
  RevisitResult result = RevisitResult::kMissed;
  std::string reason;         ///< why not corrected
  std::int64_t stamp_ns = 0;  ///< of the correction, else of the closest approach
  double travelled_m = 0.0;
  double entrance_rad = 0.0;  ///< heading on entering minus that of the first visit, left positive
  std::optional<std::int64_t> landmark;
  std::optional<std::int64_t>
      landmark_stamp_ns;              ///< of its panorama; else, where nothing was found, of the first visit
  bool landmark_was_earlier = false;  ///< that stamp lies in the earlier journey
  std::optional<double> heading_rad;  ///< yaw now minus yaw at the landmark, as it was found
  double true_heading_rad = 0.0;      ///< the same, as it is
  double distance_m = 0.0;            ///< between the two viewpoints, true
  int corrections = 0;                ///< applied during this visit
  std::optional<double> binocular_m;  ///< 2D errors at `stamp_ns`
  std::optional<double> before_m, after_m;
  std::optional<double> binocular_heading_rad, before_heading_rad, after_heading_rad;
  std::optional<double> landmark_m, landmark_heading_rad;  ///< the landmark's own error when it was made
  std::optional<double> beyond_m;                          ///< after_m beyond the landmark's own
  bool is_wrong = false;
};

struct RevisitScore {
  std::vector<Revisit> revisits;
  std::vector<AppliedCorrection> applied;                                                   ///< all, in order of time
  int listed = 0, corrected = 0, heading_only = 0, given_up = 0, rejected = 0, missed = 0;  ///< of the listed ones
  int elsewhere = 0;     ///< rows of places that are not listed
  int wrong = 0;         ///< corrections
  int not_reached = 0;   ///< listed passes before the run began or after it ended: no lines
  int before_start = 0;  ///< outcomes outside of the truth's time, left out
};

/// With a list of visits: its revisits, a line each; other places that corrected the pose come with a line of their own. Without:
/// what outcomes.csv says.
RevisitScore score_revisits(const JourneyFrames& frames);

}  // namespace panvo::evaluation
