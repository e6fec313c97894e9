// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fault.hpp"
#include "panvo/evaluation/trust_run.hpp"

namespace panvo::test {

/// A recording with ground truth into which faults are injected.
struct FaultInput {
  std::filesystem::path folder;
  std::string name;           ///< name of the folder of its runs
  std::int64_t begin_ns = 0;  ///< stamp of the first message
  double span_s = 0.0;
};

/// Throws std::runtime_error unless the folder is a recording with stereo pairs and ground truth.
FaultInput open_input(const std::filesystem::path& folder);

struct FaultRun {
  const FaultKind* kind = nullptr;
  const FaultInput* input = nullptr;
  std::uint64_t seed = 1;

  std::string name() const;  ///< "campus_clip/both_frozen-1"
};

struct FaultResult {
  FaultRun run;
  std::optional<evaluation::TrustScore> score;
  std::size_t unscored_poses = 0;  ///< outside the time span of the ground truth, or with an invalid covariance
  std::string failure;             ///< why there is no score
};

struct FaultRunOptions {
  std::filesystem::path program, system;  ///< panvo_run, and the system with the injector
  std::filesystem::path out;
  std::string key;  ///< identifies programs and settings; runs with another key are repeated
  int jobs = 1;
};

/// Plays all runs, `jobs` in parallel, except those that `out` already has with the same key, and scores them. `tell`
/// receives progress messages.
std::vector<FaultResult> play_faults(const std::vector<FaultRun>& runs, const FaultRunOptions& options,
                                     const std::function<void(const std::string&)>& tell);

}  // namespace panvo::test
