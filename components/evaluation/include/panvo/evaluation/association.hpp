// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "panvo/evaluation/trajectory.hpp"

namespace panvo::evaluation {

// Estimate and ground truth at one time. The two may stand in different frames: see alignment.hpp.
struct PosePair {
  std::int64_t stamp_ns = 0;         // the estimate's
  std::size_t estimate_index = 0;    // which pose of the estimate this is
  Eigen::Isometry3d map_from_base;   // ground truth
  Eigen::Isometry3d odom_from_base;  // estimate
};

enum class AssociationMethod {
  kInterpolate,  // ground truth interpolated at the estimate's stamp
  kNearest,      // the ground-truth pose nearest in time
};

struct AssociationOptions {
  AssociationMethod method = AssociationMethod::kInterpolate;
  // kInterpolate: the widest gap in the ground truth that is bridged; kNearest: the largest difference in time.
  // 0 takes 2.5 or 0.5 median periods of the ground truth.
  std::int64_t tolerance_ns = 0;
};

struct Association {
  std::vector<PosePair> pairs;
  AssociationMethod method = AssociationMethod::kInterpolate;
  std::int64_t tolerance_ns = 0;           // in force
  std::int64_t largest_difference_ns = 0;  // from an estimate's stamp to the nearest ground-truth pose used
  std::size_t unmatched = 0;               // poses of the estimate without ground truth
};

// Two clocks that write the same instant with other digits differ by less than this.
constexpr std::int64_t kSameStampNs = 100'000;

// Fewer pairs say nothing about a path.
constexpr std::size_t kFewestPairs = 3;

// Pairs in order of time. Throws InputError, with both spans of time, if fewer than kFewestPairs come about.
Association associate(const Trajectory& estimate, const Trajectory& ground_truth,
                      const AssociationOptions& options = {});

}  // namespace panvo::evaluation
