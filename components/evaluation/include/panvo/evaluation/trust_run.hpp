// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "panvo/evaluation/trust.hpp"

namespace panvo::evaluation {

/// What a run's files say of how far its poses were to be trusted.
struct TrustRun {
  std::vector<TrustSample> samples;  ///< in order of stamp
  std::size_t without_truth = 0;     ///< poses of a time that the truth does not tell of
  std::size_t without_sigma = 0;     ///< poses whose covariance is not there or not positive definite
};

/// Each pose of odometry_enhanced.tum against ground_truth.tum, both of `folder`, from the common start, with what states.csv and
/// integrity.csv (where there is one) had said by its stamp. Unlike elsewhere stamps need not grow: a clock that jumps is what this is about.
/// Throws InputError (file, line, what to do).
TrustRun read_trust_run(const std::filesystem::path& folder);

}  // namespace panvo::evaluation
