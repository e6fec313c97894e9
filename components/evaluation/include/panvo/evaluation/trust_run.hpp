// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "panvo/evaluation/trust.hpp"

namespace panvo::evaluation {

/// Poses of a run with the errors and the integrity information of its files.
struct TrustRun {
  std::vector<TrustSample> samples;  ///< in order of stamp
  std::size_t without_truth = 0;     ///< poses outside the time span of the ground truth
  std::size_t without_sigma = 0;     ///< poses whose covariance is missing or not positive definite
};

/// Compares each pose of odometry_enhanced.tum with ground_truth.tum, both in `folder`, with aligned starts, and adds
/// the latest states from states.csv and integrity.csv (optional) at its stamp. Stamps need not increase here, because
/// clock jumps are among the faults. Throws InputError (file, line, remedy).
TrustRun read_trust_run(const std::filesystem::path& folder);

}  // namespace panvo::evaluation
