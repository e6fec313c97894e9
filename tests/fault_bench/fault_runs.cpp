// SPDX-License-Identifier: Apache-2.0
#include "fault_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "panvo/dataset_player/dataset.hpp"
#include "panvo/dataset_player/timeline.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "process.hpp"

namespace panvo::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDone = "fault.key";

std::string key_of(const FaultRun& run, const FaultRunOptions& options) {
  return fmt::format("{} {} {}\n", options.key, run.input->folder.string(), run.input->span_s);
}

bool is_done(const fs::path& folder, const std::string& key) {
  return fs::exists(folder / kDone) && read_file(folder / kDone) == key;
}

/// Plays one run. Returns the error, or an empty string.
std::string play(const FaultRun& run, const FaultRunOptions& options, const fs::path& folder) {
  const std::string key = key_of(run, options);
  if (is_done(folder, key)) return {};
  fs::remove_all(folder);
  fs::create_directories(folder);
  const Finished finished =
      test::run({options.program.string(), options.system.string(), "dataset:=" + run.input->folder.string(),
                 "kind:=" + std::string(run.kind->name), "seed:=" + std::to_string(run.seed),
                 fmt::format("span_s:={}", run.input->span_s), "--out", folder.string(), "--replay"},
                std::chrono::seconds(900));
  std::ofstream(folder / "output.log") << finished.output;
  if (finished.status != 0)
    return fmt::format("exit status {}, see {}", finished.status, (folder / "output.log").string());
  std::ofstream(folder / kDone) << key;
  return {};
}

std::optional<evaluation::Disturbance> disturbance_of(const FaultRun& run) {
  if (run.kind == &fault_kinds().front()) return std::nullopt;
  const FaultWindow window = fault_window(*run.kind, run.seed, run.input->span_s);
  const auto at = [&](double t_s) { return run.input->begin_ns + static_cast<std::int64_t>(t_s * 1e9); };
  evaluation::Disturbance disturbance{at(window.from_s), std::nullopt};
  if (run.kind->lasting == Lasting::kWhile) disturbance.to_ns = at(window.to_s);
  return disturbance;
}

FaultResult play_and_score(const FaultRun& run, const FaultRunOptions& options) {
  FaultResult result{run, std::nullopt, 0, {}};
  const fs::path folder = options.out / "runs" / run.name();
  try {
    result.failure = play(run, options, folder);
    if (!result.failure.empty()) return result;
    const auto played = evaluation::read_trust_run(folder);
    result.unscored_poses = played.without_truth + played.without_sigma;
    result.score = evaluation::score_trust(played.samples, disturbance_of(run));
  } catch (const std::exception& error) {
    result.failure = error.what();
  }
  return result;
}

/// How far it is, and how long it goes on if it goes on like this.
class Progress {
 public:
  Progress(std::size_t count, const std::function<void(const std::string&)>& tell) : count_(count), tell_(tell) {}

  void done(const FaultRun& run, const std::string& failure) {
    const std::lock_guard lock(mutex_);
    ++done_;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
    const double to_go_s = elapsed.count() / static_cast<double>(done_) * static_cast<double>(count_ - done_);
    tell_(fmt::format("{} of {} runs, {:.0f} s to go: {}{}", done_, count_, to_go_s, run.name(),
                      failure.empty() ? "" : " FAILED: " + failure));
  }

 private:
  std::size_t count_, done_ = 0;
  const std::function<void(const std::string&)>& tell_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
};

}  // namespace

std::string FaultRun::name() const { return fmt::format("{}/{}-{}", input->name, kind->name, seed); }

FaultInput open_input(const fs::path& folder) {
  const auto dataset = dataset_player::open_dataset(folder);
  if (!dataset.stereo || dataset.ground_truth.empty()) {
    throw std::runtime_error(folder.string() + ": has no stereo pairs or no ground truth; name another recording");
  }
  const auto events = dataset_player::timeline(dataset, {});
  const fs::path whole = fs::canonical(folder);
  return {whole, whole.filename().string(), events.front().stamp_ns,
          static_cast<double>(events.back().stamp_ns - events.front().stamp_ns) * 1e-9};
}

std::vector<FaultResult> play_faults(const std::vector<FaultRun>& runs, const FaultRunOptions& options,
                                     const std::function<void(const std::string&)>& tell) {
  std::vector<FaultResult> results(runs.size());
  Progress progress(runs.size(), tell);
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < runs.size(); i = next++) {
      results[i] = play_and_score(runs[i], options);
      progress.done(runs[i], results[i].failure);
    }
  };
  std::vector<std::jthread> workers;
  for (int i = 0; i < options.jobs; ++i) workers.emplace_back(work);
  workers.clear();
  return results;
}

}  // namespace panvo::test
