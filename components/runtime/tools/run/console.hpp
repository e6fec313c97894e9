// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "panvo/runtime/logger.hpp"
#include "panvo/runtime/source.hpp"

namespace spdlog {
class logger;
}

namespace panvo::runtime {

/// What a run says: log lines on stderr and, whole, in the run's log file; below them, where stderr is a terminal, one line of progress.
class Console {
 public:
  /// `log_file` empty: none. `show`: the least level that goes to stderr. Throws std::runtime_error when the file cannot be written.
  Console(const std::filesystem::path& log_file, LogLevel show);
  ~Console();

  void log(LogLevel level, const std::string& component, const std::string& text);
  void progress(Source::Progress progress);
  /// Leaves the last progress line standing.
  void end_progress();

 private:
  void clear_progress();

  const LogLevel show_;
  const bool is_terminal_;
  std::mutex mutex_;
  std::shared_ptr<spdlog::logger> file_;
  std::int64_t start_ns_;
  std::string progress_line_;
  int last_tenth_ = -1;
};

}  // namespace panvo::runtime
