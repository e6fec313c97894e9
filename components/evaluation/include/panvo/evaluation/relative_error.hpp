// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "panvo/evaluation/association.hpp"
#include "panvo/evaluation/statistics.hpp"

namespace panvo::evaluation {

// Mean error of all segments of one length.
struct SegmentError {
  double length_m = 0.0;
  std::size_t count = 0;
  double translation_percent = 0.0;
  double rotation_deg_per_m = 0.0;
};

// As in KITTI's development kit [Geiger2012]: error of the relative pose from every `step`-th pose to the first pose at
// least `length` further along the ground truth, divided by the nominal length.
struct SegmentErrors {
  std::vector<SegmentError> by_length;  // only lengths that fit into the path
  std::size_t count = 0;
  double translation_percent = 0.0;  // mean over all segments of all lengths
  double rotation_deg_per_m = 0.0;
};

struct SegmentOptions {
  std::vector<double> lengths_m;  // empty: suitable_segment_lengths_m()
  std::size_t step = 0;           // poses between segment starts; 0: 10 for the lengths of KITTI, else 1
};

// 100..800 m for paths of at least 200 m, 10..50 m for at least 50 m, else 10..50 % of the path.
std::vector<double> suitable_segment_lengths_m(double path_length_m);

// nullopt if no segment fits. Throws InputError for a length that is not positive.
std::optional<SegmentErrors> segment_errors(std::span<const PosePair> pairs, const SegmentOptions& options = {});

// Relative pose error.
struct RelativePoseError {
  Summary translation;   // m per step, or m per metre
  Summary rotation_deg;  // degrees per step, or degrees per metre
};

// From each pair to the next. Pairs more than 1.5 median periods apart are skipped, because frames are missing between
// them.
std::optional<RelativePoseError> relative_error_per_frame(std::span<const PosePair> pairs);

// From each pair to the first pair at least 1 m further, divided by the true length.
std::optional<RelativePoseError> relative_error_per_metre(std::span<const PosePair> pairs);

}  // namespace panvo::evaluation
