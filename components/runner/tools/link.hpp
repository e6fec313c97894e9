// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "panvo/runtime/container.hpp"

namespace panvo::runner {

/// Synchronises a container process with others of the same system, through two pipes to the launcher: it reports its
/// topics after loading, receives the expected peers, waits until they are connected, and starts when all are. Line
/// protocol; to the launcher: "publishes NAME", "subscribes NAME", "has_source", "loaded", then "connected"; from it:
/// "await NAME READERS WRITERS", "connect", then "start".
class Link {
 public:
  Link(int in, int out, const std::atomic<bool>& stop) : in_(in), out_(out), stop_(stop) {}

  /// Returns when all containers of the system are connected, or on `stop`. Throws std::runtime_error if the launcher
  /// is gone.
  void meet(runtime::Container& container, const runtime::Logger::Write& log);

 private:
  std::optional<std::string> read_line();
  void write_line(const std::string& line);

  int in_, out_;
  const std::atomic<bool>& stop_;
};

/// Reads a line from a pipe; nullopt at its end, or on `stop`.
std::optional<std::string> read_pipe_line(int pipe, const std::atomic<bool>& stop);
/// Writes a line to a pipe; false if the reader is gone.
bool write_pipe_line(int pipe, const std::string& line);

}  // namespace panvo::runner
