// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/landmarks/stored_run.hpp"

namespace panvo::landmarks {

/// Keeps the runs of the component that stores the landmarks of `own`: its namespace tells robots apart.
void keep_of_component(std::vector<StoredRun>& runs, const StoredRun& own);

/// Tells from what other components say whether they go on with one of the runs that a store has kept, so that they have
/// its landmarks by the ids of that run: the process with the store may have been restarted alone, by somebody who does
/// not tell it the run.
class RunFinder {
 public:
  /// Within it, a pose is that of the stored landmark: the map has changed little since the last pose was stored.
  static constexpr double kSamePlace_m = 5.0;

  /// nullopt if no run has another id than the store for one of its landmarks, so that it makes no difference.
  static std::optional<RunFinder> among(std::vector<StoredRun> runs, const LandmarkStore& store);

  /// A landmark that somebody has built: it says which run this is, or which it is not. Returns whether it says it first.
  bool hear(const PanoramicLandmark& landmark);
  /// Poses of the map's owner: they say it less surely, and only where one id is at different places in the two.
  void hear(const std::vector<LandmarkPose>& poses);

  const std::map<std::uint32_t, LandmarkPose>& poses() const noexcept { return poses_; }
  /// The run by what was heard so far; nullopt: none of these.
  std::optional<StoredRun> found() const;

 private:
  struct Stored {
    std::int64_t stamp_ns = 0;
    std::vector<float> histogram;  // where robots are simulated, two landmarks may have one stamp
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
  };

  RunFinder(std::vector<StoredRun> runs, const std::vector<PanoramicLandmark>& stored);

  bool is_needed() const;
  bool is_near(std::uint32_t stored_id, const LandmarkPose& pose) const;
  int votes_for(const StoredRun& run) const;

  std::vector<StoredRun> runs_;  // that were not ruled out
  std::map<std::uint32_t, Stored> stored_;
  std::map<std::uint32_t, LandmarkPose> poses_;  // heard last
  std::optional<StoredRun> said_;
};

}  // namespace panvo::landmarks
