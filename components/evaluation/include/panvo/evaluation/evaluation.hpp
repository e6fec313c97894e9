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
  Alignment alignment = Alignment::kStart;  // for errors.csv and the plot only; the table has both ATEs
  AssociationOptions association;
  SegmentOptions segments;
  ConsistencyOptions consistency;
};

// Results for one estimate. nullopt: could not be computed.
struct Evaluation {
  std::string name;
  std::filesystem::path source;
  std::size_t poses = 0;                  // of the estimate
  std::size_t pairs = 0;                  // poses with ground truth
  std::optional<std::size_t> unreliable;  // frames without measured motion
  AssociationMethod association = AssociationMethod::kInterpolate;
  std::int64_t tolerance_ns = 0;
  std::int64_t max_difference_ns = 0;
  double duration_s = 0.0;        // from the first pair to the last
  double path_length_m = 0.0;     // of the ground truth at the pairs
  double coverage_percent = 0.0;  // of the whole length of the ground truth

  std::optional<Summary> ate_start_m;
  std::optional<Summary> ate_se3_m;
  std::optional<Summary> rotation_start_deg;
  std::optional<double> scale_error_percent;  // from Sim3 alignment; positive: estimate too long
  std::optional<double> end_error_m;          // start-aligned, at the last pair
  std::optional<double> end_error_percent;    // of the path length
  std::optional<double> end_rotation_deg;
  std::optional<SegmentErrors> segments;
  std::optional<RelativePoseError> per_frame;
  std::optional<RelativePoseError> per_metre;
  std::optional<Consistency> nees;
  std::optional<StageTimes> timing;

  Alignment alignment = Alignment::kStart;
  std::vector<PoseError> errors;  // under `alignment`
};

// Throws InputError if estimate and ground truth do not overlap in time, or the requested alignment is undetermined.
Evaluation evaluate(const Estimate& estimate, const Trajectory& ground_truth, const Options& options = {});

}  // namespace panvo::evaluation
