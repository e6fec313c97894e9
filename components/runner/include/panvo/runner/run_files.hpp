// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "panvo/runtime/container.hpp"

namespace panvo::runner {

/// Contents of summary.json.
struct RunSummary {
  std::uint64_t frames_in = 0, frames_out = 0;
  std::uint64_t frames_unreliable = 0;  ///< poses without measured motion
  std::uint64_t lines = 0;              ///< in the result files
  std::vector<runtime::QueueCounters> queues;
  double cpu_s = 0.0, wall_s = 0.0, peak_memory_mb = 0.0;
  std::string version;
  std::uint64_t seed = 0;
  bool replay = false;
  std::string system_file;
  std::map<std::string, std::map<std::string, std::string>> changed_parameters;  ///< component, parameter, value
  std::vector<std::string> problems;
  bool interrupted = false;  ///< stopped before all data was played
  int exit_status = 0;
};

/// The result files of a run: odometry, landmarks and matches are written line by line as they are published, so a
/// killed run leaves valid files; timing.json and summary.json are written atomically at the end. Files of an earlier
/// run under these names are removed. Each method throws std::runtime_error, naming the file, on a write error (disk
/// full, folder not writable); earlier complete lines are kept.
///
/// `*.tum`: `t x y z qx qy qz qw`; stamp in s with nine decimals, position in m in the message's frame (odom, map),
/// rotation as unit quaternion. Other numbers have the shortest form that restores them exactly. Undecodable messages
/// and messages with non-finite numbers are left out and counted in the summary's problems.
class RunFiles {
 public:
  /// Creates the folder and its parents.
  explicit RunFiles(std::filesystem::path folder);
  ~RunFiles();
  RunFiles(const RunFiles&) = delete;
  RunFiles& operator=(const RunFiles&) = delete;

  /// True for nav_msgs/msg/Odometry topics that end in /odometry/binocular, /odometry/enhanced, /odometry/fleet or
  /// /ground_truth/odometry, and for the topics of landmarks, matches, quality, azimuth changes, corrections, states
  /// and integrity.
  bool wants(const runtime::TopicDescription& topic) const;

  /// Appends a message of a topic that wants() accepts; ignores others. If two topics have the same ending (two
  /// robots), the first has the plain file name; the others are prefixed with their namespace.
  void write(const runtime::TopicDescription& topic, const runtime::SamplePtr& sample);

  /// Messages written.
  std::uint64_t lines() const;

  void finish(const RunSummary& summary, const runtime::ComponentTimes& times_by_component);

 private:
  struct TopicFile;

  std::filesystem::path folder_;
  std::map<std::string, std::vector<std::unique_ptr<TopicFile>>> files_by_topic_;
};

/// Whether a run writes results under this file name; `may_have_namespace`: also those of further robots.
bool is_result_file(std::string_view name, bool may_have_namespace);

/// What to report of a run without results.
std::string nothing_written(const std::filesystem::path& folder);

/// Creates the folder for the results of a run and marks it, so that the next run may replace its contents. Removes the
/// results of an earlier run, which a run of other topics would leave beside its own. Throws ConfigError if the folder
/// has contents that no run has written, unless `overwrite` is set: then the run's files are replaced and other files
/// are kept.
void claim_run_folder(const std::filesystem::path& folder, bool overwrite);

/// Merges the results that several containers left in `subfolders` of `folder` (names). timing.json: joins the
/// components. summary.json: adds frames, CPU time, memory and lists; takes the longest wall time and the first exit
/// status other than 0. Other files are moved up, prefixed with the subfolder's name if two have the same name. A
/// container without a summary was killed: a problem and exit status 1. The same, and false is returned, if
/// `must_have_results` and no container wrote a line. Throws std::runtime_error like RunFiles.
bool merge_run_files(const std::filesystem::path& folder, const std::vector<std::string>& subfolders,
                     bool must_have_results);

}  // namespace panvo::runner
