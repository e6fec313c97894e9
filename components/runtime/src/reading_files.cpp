// SPDX-License-Identifier: Apache-2.0
// Reading of files from earlier runs, which may be bad.
#include <fmt/format.h>

#include "clocks.hpp"
#include "context_state.hpp"
#include "file_trial.hpp"

namespace panvo::runtime {
namespace {

// A bad landmark causes a failure at the first panorama, soon after the start.
constexpr std::int64_t kTrial_ns = 10'000'000'000;

}  // namespace

void Context::about_to_read(const std::filesystem::path& file) { state_->begin_reading(file); }

void Context::State::begin_reading(const std::filesystem::path& file) {
  if (host.replay_order) return;
  const auto bad = begin_trial(file);
  const std::lock_guard lock(files_mutex_);
  if (!bad) return files_on_trial_.push_back({file, clocks::monotonic_ns()});
  files_set_aside_.push_back(fmt::format("{} was set aside as {}", file.string(), bad->string()));
  logger.error(
      "{}: the last {} runs that read it failed. This run continues without it; repair it and move it back, or "
      "delete it",
      files_set_aside_.back(), kMaxFailures);
}

void Context::State::trust_files(std::int64_t now_ns) {
  if (failed()) return;
  const std::lock_guard lock(files_mutex_);
  std::erase_if(files_on_trial_, [&](const FileOnTrial& trial) {
    if (now_ns - trial.since_ns < kTrial_ns) return false;
    end_trial(trial.file);
    return true;
  });
}

std::vector<std::string> Context::State::files_set_aside() const {
  const std::lock_guard lock(files_mutex_);
  return files_set_aside_;
}

}  // namespace panvo::runtime
