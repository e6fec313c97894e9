// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "panvo/evaluation/alignment.hpp"
#include "panvo/evaluation/association.hpp"
#include "panvo/evaluation/consistency.hpp"
#include "panvo/evaluation/pose_error.hpp"
#include "panvo/evaluation/relative_error.hpp"
#include "panvo/evaluation/run_folder.hpp"
#include "panvo/evaluation/timing.hpp"

namespace panvo::evaluation {

struct Options {
  Alignment alignment = Alignment::kStart;  // of the error series: errors.csv and plot. The table gives both ATEs
  AssociationOptions association;
  SegmentOptions segments;
  ConsistencyOptions consistency;
};

// Everything that is said about one estimate. What could not be computed is nullopt.
struct Evaluation {
  std::string name;
  std::filesystem::path source;
  std::size_t poses = 0;                  // of the estimate
  std::size_t pairs = 0;                  // of them with ground truth
  std::optional<std::size_t> unreliable;  // frames of the run whose motion was not measured
  AssociationMethod association = AssociationMethod::kInterpolate;
  std::int64_t tolerance_ns = 0;
  std::int64_t largest_difference_ns = 0;
  double duration_s = 0.0;        // from the first pair to the last
  double path_length_m = 0.0;     // of the ground truth at the pairs
  double coverage_percent = 0.0;  // of the ground truth's whole length

  std::optional<Summary> ate_start_m;
  std::optional<Summary> ate_se3_m;
  std::optional<Summary> rotation_start_deg;
  std::optional<double> scale_error_percent;  // by Sim3; positive: the estimate is too long. Information only
  std::optional<double> end_error_m;          // start-aligned, at the last pair
  std::optional<double> end_error_percent;    // of the path's length
  std::optional<double> end_rotation_deg;
  std::optional<SegmentErrors> segments;
  std::optional<RelativePoseError> per_frame;
  std::optional<RelativePoseError> per_metre;
  std::optional<Consistency> nees;
  std::optional<StageTimes> timing;

  Alignment alignment = Alignment::kStart;
  std::vector<PoseError> errors;  // under `alignment`
};

// Throws InputError where estimate and ground truth do not meet in time, or the alignment asked for is not determined.
Evaluation evaluate(const Estimate& estimate, const Trajectory& ground_truth, const Options& options = {});

}  // namespace panvo::evaluation
