// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "panvo/evaluation/trajectory.hpp"

namespace panvo::evaluation {

// Estimate and ground truth at one time. The frames may differ, see alignment.hpp.
struct PosePair {
  std::int64_t stamp_ns = 0;         // of the estimate
  std::size_t estimate_index = 0;    // index of the pose in the estimate
  Eigen::Isometry3d map_from_base;   // ground truth
  Eigen::Isometry3d odom_from_base;  // estimate
};

enum class AssociationMethod {
  kInterpolate,  // ground truth interpolated at the estimate's stamp
  kNearest,      // the ground-truth pose nearest in time
};

struct AssociationOptions {
  AssociationMethod method = AssociationMethod::kInterpolate;
  // kInterpolate: largest gap in the ground truth to interpolate over; kNearest: largest time difference.
  // 0: 2.5 or 0.5 median periods of the ground truth.
  std::int64_t tolerance_ns = 0;
};

struct Association {
  std::vector<PosePair> pairs;
  AssociationMethod method = AssociationMethod::kInterpolate;
  std::int64_t tolerance_ns = 0;       // that was applied
  std::int64_t max_difference_ns = 0;  // between an estimate's stamp and the nearest ground-truth pose used
  std::size_t unmatched = 0;           // poses of the estimate without ground truth
};

// Stamps of the same instant differ by less than this if they were rounded differently.
constexpr std::int64_t kSameStampNs = 100'000;

// Minimum number of pairs for an evaluation.
constexpr std::size_t kMinPairs = 3;

// Returns pairs in order of time. Throws InputError, naming both time spans, if there are fewer than kMinPairs.
Association associate(const Trajectory& estimate, const Trajectory& ground_truth,
                      const AssociationOptions& options = {});

}  // namespace panvo::evaluation
