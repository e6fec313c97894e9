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

/// A recording with truth that faults are put into.
struct FaultInput {
  std::filesystem::path folder;
  std::string name;           ///< of its runs' folder
  std::int64_t begin_ns = 0;  ///< of the first thing played
  double span_s = 0.0;
};

/// Throws std::runtime_error for a folder that is no recording with stereo pairs and truth.
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
  std::size_t unscored_poses = 0;  ///< of a time that the truth does not tell of, or with a covariance that is none
  std::string failure;             ///< why there is no score
};

struct FaultRunOptions {
  std::filesystem::path program, system;  ///< panvo_run, and the system with the injector
  std::filesystem::path out;
  std::string key;  ///< of what is run: a run that another one left is not taken for this one's
  int jobs = 1;
};

/// Plays every run, `jobs` at once, except those that `out` has already from the same key, and scores them. `tell` gets a line for people now and then.
std::vector<FaultResult> play_faults(const std::vector<FaultRun>& runs, const FaultRunOptions& options,
                                     const std::function<void(const std::string&)>& tell);

}  // namespace panvo::test
