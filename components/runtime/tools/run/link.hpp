// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "panvo/runtime/container.hpp"

namespace panvo::runtime {

/// How a container process meets those of the same system, through two pipes to the process that launched it: it reports its topics once
/// loaded, is told which of them the others read, waits until they are connected, and starts when all are.
/// Lines of text; to the launcher: "publishes NAME", "subscribes NAME", "has_source", "loaded", then "connected"; from it: "await NAME READERS WRITERS",
/// "connect", then "start".
class Link {
 public:
  Link(int in, int out) : in_(in), out_(out) {}

  /// Returns when all containers of the system are connected. Throws std::runtime_error when the launcher is gone.
  void meet(Container& container, const Logger::Write& log);

 private:
  std::string read_line();
  void write_line(const std::string& line);

  int in_, out_;
};

/// Reads one line from a pipe; nullopt at its end.
std::optional<std::string> read_pipe_line(int pipe);
/// Writes a line to a pipe; false when nobody reads it any more.
bool write_pipe_line(int pipe, const std::string& line);

}  // namespace panvo::runtime
