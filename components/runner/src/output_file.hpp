// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace panvo::runner {

/// A text file that always ends in a complete line: each line is written at once and removed again if it does not fit
/// on the disk. Throws std::runtime_error with file, problem and remedy.
class LineFile {
 public:
  /// Creates or truncates the file.
  explicit LineFile(std::filesystem::path path);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// `line` without newline.
  void append(std::string_view line);
  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::int64_t size_ = 0;  ///< of the complete lines
};

/// Replaces a file atomically: readers, and a crash, see the old or the new content, never a part. Throws like
/// LineFile.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// Throws LineFile's error for the errno value `error`.
[[noreturn]] void throw_cannot_write(const std::filesystem::path& path, int error);

}  // namespace panvo::runner
