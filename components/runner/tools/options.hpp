// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/system_file.hpp"

namespace panvo::runner {

enum class ExitStatus : int {
  kOk = 0,
  kRunFailed = 1,
  kBadConfiguration = 2,
  kHungUp = 129,
  kInterrupted = 130,
  kTerminated = 143
};

/// Exit status of a run ended by SIGINT, SIGTERM or SIGHUP before the end of the data.
constexpr ExitStatus interrupted_by(int signal) { return static_cast<ExitStatus>(128 + signal); }

/// Options of `panvo run`.
struct RunOptions {
  std::string system_file;
  std::map<std::string, std::string> arguments;  // name:=value
  std::string dataset, bag, out;
  std::string calibration;  // folder, for stereo images without camera_info
  bool view = false;        // serve the topics to a browser
  bool overwrite = false;   // replace files in `out` that are not from a run
  bool replay = false;
  double rate = 0;
  std::vector<std::string> settings;                    // component.parameter=value
  std::vector<std::string> ros_parameters, ros_remaps;  // ROS 2's options -p and -r
  std::uint64_t seed = 1;
  runtime::DdsSettings dds;  // domain, profiles, ROS 2 distribution
  bool local = false;
  bool verbose = false;
  bool describe = false;  // print topics and nodes, and exit
  std::string container;  // run only this container
  bool respawn = false;   // restart containers that crash or fail
  double respawn_delay_s = 1;
  std::vector<std::string> awaited;      // topics that must have peers before the start
  std::optional<int> link_in, link_out;  // pipes to the launcher
  bool again = false;                    // replaces a process that crashed
  std::string run_id;                    // of the launcher's run; empty: a run of its own

  /// Parses a command line. Returns an exit status if there is nothing to run (`--help`, or an error, which is
  /// printed).
  static std::optional<int> parse(int argc, char** argv, RunOptions& options);
};

/// The system to run: file with arguments and settings applied, and the player of the data set or bag. Throws
/// ConfigError.
runtime::SystemDescription describe_system(const RunOptions& options);

}  // namespace panvo::runner
