// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::test {

/// A child process whose output goes to a file.
class Process {
 public:
  /// `words[0]` is the path of the program. Throws std::runtime_error if it cannot be started.
  explicit Process(const std::vector<std::string>& words);
  ~Process();  // kills the process if it still runs
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const;
  pid_t id() const noexcept { return pid_; }

  /// Waits for the end. Returns the exit status, or 128 + signal; kills the process and returns -1 after `limit`.
  int wait(std::chrono::seconds limit = std::chrono::seconds(100));

  /// Its standard output and error so far.
  std::string output() const;

 private:
  pid_t pid_ = -1;
  TemporaryFolder folder_;
};

/// The child process of `parent` with `word` in its command line; 0 if there is none.
pid_t child_of(const Process& parent, const std::string& word);

struct Finished {
  int status;
  std::string output;
};

/// Runs a program to its end.
Finished run(const std::vector<std::string>& words, std::chrono::seconds limit = std::chrono::seconds(100));

/// Polls `condition` every few milliseconds; false if it does not hold within the limit.
[[nodiscard]] bool eventually(const std::function<bool()>& condition,
                              std::chrono::seconds limit = std::chrono::seconds(60));

/// Path of an installed program, searched in $PATH, /usr/sbin and /sbin; empty if not installed.
std::string find_program(const std::string& name);

std::string read_file(const std::filesystem::path& file);

}  // namespace panvo::test
