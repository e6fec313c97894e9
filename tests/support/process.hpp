// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace panvo::test {

/// A program started with its output going to a file.
class Process {
 public:
  /// `words[0]` is the program's path. Throws std::runtime_error when it cannot be started.
  explicit Process(const std::vector<std::string>& words);
  ~Process();  // kills what still runs
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const;
  pid_t id() const noexcept { return pid_; }

  /// Exit status, or 128 + signal. Kills the process and returns -1 when `limit` has passed.
  int wait(std::chrono::seconds limit = std::chrono::seconds(100));

  /// All it has written so far, standard output and error together.
  std::string output() const;

 private:
  pid_t pid_ = -1;
  std::filesystem::path output_file_;
};

struct Finished {
  int status;
  std::string output;
};

/// Runs a program to its end.
Finished run(const std::vector<std::string>& words, std::chrono::seconds limit = std::chrono::seconds(100));

/// Looks every few milliseconds whether `condition` holds; false when it did not before the limit.
[[nodiscard]] bool eventually(const std::function<bool()>& condition,
                              std::chrono::seconds limit = std::chrono::seconds(60));

/// The path of a program of the system's, looked for in $PATH and where administrators have theirs; empty: not installed.
std::string find_program(const std::string& name);

/// A folder that is removed with its owner.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const noexcept { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::string read_file(const std::filesystem::path& file);

/// The folder of recordings, $PANVO_DATA or shared/data beside the checkout, with `name` in it; empty if there is none.
std::filesystem::path recording(const std::string& name);

}  // namespace panvo::test
