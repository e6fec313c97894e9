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

namespace panvo::runner {

/// Output of a run: log lines on stderr and, complete, in the log file; on a terminal also a progress line.
class Console {
 public:
  /// `log_file` may be empty. `show`: lowest level shown on stderr. Throws std::runtime_error if the file cannot be
  /// written.
  Console(const std::filesystem::path& log_file, runtime::LogLevel show);
  ~Console();

  void log(runtime::LogLevel level, const std::string& component, const std::string& text);
  void progress(runtime::Source::Progress progress);
  /// Keeps the last progress line on the screen.
  void end_progress();

 private:
  void clear_progress();

  const runtime::LogLevel show_;
  const bool is_terminal_;
  std::mutex mutex_;
  std::shared_ptr<spdlog::logger> file_;
  std::int64_t start_ns_;
  std::string progress_line_;
  int last_tenth_ = -1;
};

}  // namespace panvo::runner
