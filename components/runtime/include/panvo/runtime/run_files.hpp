// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/sample.hpp"
#include "panvo/runtime/stage_times.hpp"

namespace panvo::runtime {

/// What went through one input of one component.
struct QueueCounters {
  std::string component;
  std::string input;  ///< resolved topic name
  std::uint64_t received = 0, handled = 0, dropped = 0;
};

/// What summary.json says of a run.
struct RunSummary {
  std::uint64_t frames_in = 0, frames_out = 0;
  std::uint64_t frames_unreliable = 0;  ///< of those out: without a motion that was measured
  std::vector<QueueCounters> queues;
  double cpu_s = 0.0, wall_s = 0.0, peak_memory_mb = 0.0;
  std::string version;
  std::uint64_t seed = 0;
  bool replay = false;
  std::string system_file;
  std::map<std::string, std::map<std::string, std::string>> changed_parameters;  ///< component, parameter, value
  std::vector<std::string> problems;
  bool interrupted = false;  ///< asked to stop while something was still to be played
  int exit_status = 0;
};

/// Stage times by component and stage.
using ComponentTimes = std::map<std::string, std::map<std::string, StageTimes::Times, std::less<>>>;

/// The files that a run leaves in its folder: odometry, landmarks and matches as they are published, line by line, so that a run
/// that is killed leaves what it had; and, at the end, timing.json and summary.json, whole or not at all.
/// What an earlier run left under these names is removed. Every method throws std::runtime_error, naming the
/// file, when it cannot be written (full disk, folder not writable); what was written before stays and is
/// whole lines. Safe to use from several threads.
///
/// `*.tum`: `t x y z qx qy qz qw`, stamp in s with its nine decimals, position in m in the message's frame
/// (odom, map), rotation as unit quaternion; the other numbers as short as gives them back to the last bit. A
/// message with a number that is not finite, or whose bytes are none, is left out, and counted among the
/// summary's problems.
class RunFiles {
 public:
  /// Makes the folder, with those above it.
  explicit RunFiles(std::filesystem::path folder);
  ~RunFiles();
  RunFiles(const RunFiles&) = delete;
  RunFiles& operator=(const RunFiles&) = delete;

  /// nav_msgs/msg/Odometry topics that end in /odometry/binocular, /odometry/enhanced and
  /// /ground_truth/odometry, landmarks on /landmarks and what panoramas matched on /landmarks/match.
  bool wants(const TopicDescription& topic) const;

  /// Appends a message of a topic that wants() accepts; ignores any other. Two topics of one ending (two
  /// robots): the first has the plain file name, the others have their namespace before it.
  void write(const TopicDescription& topic, const SamplePtr& sample);

  /// Whether a message was written.
  bool has_lines() const;

  void finish(const RunSummary& summary, const ComponentTimes& times_by_component);

 private:
  struct TopicFile;

  std::filesystem::path folder_;
  mutable std::mutex mutex_;
  std::map<std::string, std::vector<std::unique_ptr<TopicFile>>> files_by_topic_;
};

/// Makes the folder for the results of a run, and marks it as one, so that the next run may replace what is in it. Throws ConfigError if it
/// holds anything and no run left it there, unless `overwrite`: then files of the names that a run writes are replaced, the others stay.
void claim_run_folder(const std::filesystem::path& folder, bool overwrite);

/// Makes one run of what several containers left in `subfolders` of `folder` (names): joins the components of
/// timing.json; in summary.json adds up frames, CPU time, memory and lists, takes the longest wall time and
/// the first exit status that is not 0; moves the other files up, with the subfolder's name before theirs
/// where two have the same. A container that left no summary was killed: that is a problem and exit status 1.
/// Throws std::runtime_error as RunFiles does.
void merge_run_files(const std::filesystem::path& folder, const std::vector<std::string>& subfolders);

}  // namespace panvo::runtime
