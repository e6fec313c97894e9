// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "panvo/evaluation/consistency.hpp"
#include "panvo/evaluation/timing.hpp"
#include "panvo/evaluation/trajectory.hpp"

namespace panvo::evaluation {

/// A published landmark. A landmark that was published several times has several entries.
struct RunLandmark {
  std::int64_t stamp_ns = 0;  ///< of its panorama
  std::int64_t id = 0;
  bool is_junction = false;
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
};

/// Result of matching one panorama with the landmarks.
struct RunMatch {
  std::int64_t stamp_ns = 0;
  std::string state;
  std::int64_t landmark = 0;          ///< 0: none
  std::optional<double> heading_rad;  ///< yaw now minus yaw at the landmark, left positive
  std::string reason;
};

struct RunCorrection {
  std::int64_t stamp_ns = 0;
  std::int64_t landmark = 0;
  std::string state;  ///< full, weak, rotation_only or rejected
  std::int64_t inliers = 0;
  Eigen::Isometry3d landmark_from_base = Eigen::Isometry3d::Identity();
  std::string reason;
};

struct RunOutcome {
  std::int64_t stamp_ns = 0;
  std::int64_t landmark = 0;
  std::string outcome;  ///< applied, better_known or rejected
  Eigen::Isometry3d map_from_base_before = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d map_from_base_after = Eigen::Isometry3d::Identity();
  std::string reason;
};

struct RunAzimuth {
  std::int64_t stamp_ns = 0;
  std::int64_t from_ns = 0;
  std::optional<double> change_rad;  ///< left positive; nullopt if invalid
};

struct RunQuality {
  std::int64_t stamp_ns = 0;
  bool reliable = true;
  std::int64_t tracked = 0, inliers = 0;
};

struct RunIntegrity {
  std::int64_t stamp_ns = 0;
  bool usable = true;
  std::string reason;
  std::optional<double> risk;
  std::optional<double> protection_level_m;  ///< horizontal; nullopt: unknown
  std::optional<double> alert_limit_m;       ///< nullopt: none
};

struct RunState {
  std::int64_t stamp_ns = 0;
  std::string state;
  std::string reason;
  std::optional<double> position_sigma_m;
  std::optional<double> heading_sigma_rad;
};

/// Description of the run from summary.json.
struct RunFacts {
  std::string version, system, seed;
  bool is_replay = false;
  std::optional<double> wall_s, cpu_s, peak_memory_mb;
  std::vector<std::string> problems;
  std::vector<std::pair<std::string, std::string>> changed_parameters;  ///< "component.parameter" and its value
};

/// Contents of a run folder.
struct JourneyRun {
  std::filesystem::path folder;
  std::string name;
  Trajectory binocular;  ///< odom_from_base
  Trajectory enhanced;   ///< map_from_base, as published
  std::optional<MotionCovariances> enhanced_covariances;
  std::vector<RunLandmark> landmarks;
  std::vector<RunMatch> matches;
  std::vector<RunCorrection> corrections;
  std::vector<RunOutcome> outcomes;
  std::vector<RunAzimuth> azimuths;
  std::vector<RunQuality> qualities;
  std::vector<RunState> states;
  std::vector<RunIntegrity> integrity;
  StageTimes times;
  std::optional<RunFacts> facts;
  std::vector<std::string> missing;  ///< names of missing files
};

/// Both odometries are required; other missing files are listed in `missing`. Throws InputError (file, line, remedy).
JourneyRun read_journey_run(const std::filesystem::path& folder);

}  // namespace panvo::evaluation
