// SPDX-License-Identifier: Apache-2.0
#include "console.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <stdexcept>

#include "panvo/runtime/printable.hpp"

namespace panvo::runner {
namespace {

std::int64_t now_ns() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

const char* level_text(runtime::LogLevel level) {
  switch (level) {
    case runtime::LogLevel::kDebug:
      return "debug";
    case runtime::LogLevel::kInfo:
      return "info";
    case runtime::LogLevel::kWarning:
      return "warning";
    case runtime::LogLevel::kError:
      return "error";
  }
  return "";
}

}  // namespace

Console::Console(const std::filesystem::path& log_file, runtime::LogLevel show)
    : show_(show), is_terminal_(isatty(STDERR_FILENO) == 1), start_ns_(now_ns()) {
  if (log_file.empty()) return;
  try {
    file_ = std::make_shared<spdlog::logger>(
        "run", std::make_shared<spdlog::sinks::basic_file_sink_mt>(log_file.string(), true));
  } catch (const spdlog::spdlog_ex& error) {
    throw std::runtime_error("cannot write the log " + log_file.string() + ": " + error.what());
  }
  file_->set_pattern("%Y-%m-%d %H:%M:%S.%e %v");
  file_->set_level(spdlog::level::debug);
  file_->flush_on(spdlog::level::debug);  // keeps the log of a killed run
}

Console::~Console() { end_progress(); }

void Console::log(runtime::LogLevel level, const std::string& component, const std::string& said) {
  const std::string text = runtime::printable(said);  // may contain text from other processes
  const std::lock_guard lock(mutex_);
  if (file_) file_->info("{} [{}] {}", level_text(level), component, text);
  if (level < show_) return;
  clear_progress();
  const char* colour = !is_terminal_                          ? ""
                       : level == runtime::LogLevel::kError   ? "\033[31m"
                       : level == runtime::LogLevel::kWarning ? "\033[33m"
                                                              : "";
  std::fprintf(stderr, "%s[%s] %s: %s%s\n%s", colour, component.c_str(), level_text(level), text.c_str(),
               *colour ? "\033[0m" : "", progress_line_.c_str());
  std::fflush(stderr);
}

void Console::progress(runtime::Source::Progress progress) {
  if (progress.total == 0) return;
  const std::lock_guard lock(mutex_);
  const double elapsed_s = static_cast<double>(now_ns() - start_ns_) * 1e-9;
  const double fraction = static_cast<double>(progress.done) / static_cast<double>(progress.total);
  const std::string text =
      fmt::format("{}/{} frames, {:.0f} %, {:.1f} frames/s", progress.done, progress.total, 100 * fraction,
                  elapsed_s > 0 ? static_cast<double>(progress.done) / elapsed_s : 0.0);
  if (is_terminal_) {
    clear_progress();
    constexpr int kWidth = 30;
    const int filled = static_cast<int>(fraction * kWidth);
    progress_line_ = fmt::format("[{:#<{}}{:.<{}}] {}", "", filled, "", kWidth - filled, text);
    std::fputs(progress_line_.c_str(), stderr);
    std::fflush(stderr);
  } else if (const int tenth = static_cast<int>(fraction * 10); tenth > last_tenth_) {
    last_tenth_ = tenth;
    std::fprintf(stderr, "%s\n", text.c_str());
  }
}

void Console::end_progress() {
  const std::lock_guard lock(mutex_);
  if (!progress_line_.empty()) std::fputc('\n', stderr);
  progress_line_.clear();
}

void Console::clear_progress() {
  if (!progress_line_.empty()) std::fputs("\r\033[K", stderr);
}

}  // namespace panvo::runner
