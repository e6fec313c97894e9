// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/system_file.hpp"

namespace panvo::runtime {

enum class ExitStatus : int { kOk = 0, kRunFailed = 1, kBadConfiguration = 2, kInterrupted = 130, kTerminated = 143 };

/// That of a run that SIGINT or SIGTERM ended before all was played.
constexpr ExitStatus interrupted_by(int signal) { return static_cast<ExitStatus>(128 + signal); }

/// What `panvo run` was asked to do.
struct RunOptions {
  std::string system_file;
  std::map<std::string, std::string> arguments;  // name:=value
  std::string dataset, bag, out;
  bool overwrite = false;  // files in `out` that no run left there
  bool replay = false;
  double rate = 0;
  std::vector<std::string> settings;  // component.parameter=value
  std::uint64_t seed = 1;
  DdsSettings dds;  // domain, profiles and which ROS 2 there is
  bool local = false;
  bool verbose = false;
  bool describe = false;  // say what the system has to do with others, and run nothing
  std::string container;  // only this one of the system's containers
  bool respawn = false;   // start a container again that crashes or fails
  double respawn_delay_s = 1;
  std::vector<std::string> awaited;      // topics that another process must have before this one begins
  std::optional<int> link_in, link_out;  // to the launching process
  bool again = false;                    // in the place of a process that crashed

  /// Parses a command line. Returns the exit status when there is nothing to run (`--help`, a mistake; it is said).
  static std::optional<int> parse(int argc, char** argv, RunOptions& options);
};

/// The system as it is to be run: file, arguments and settings applied, the player of the data set or bag added. Throws ConfigError.
SystemDescription describe_system(const RunOptions& options);

}  // namespace panvo::runtime
