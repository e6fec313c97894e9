// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace panvo::runtime {

/// A text file that always ends in a whole line: each is handed to the system at once, and one that does not
/// fit on the disk is taken back. Throws std::runtime_error that names the file, what is wrong and what to
/// do.
class LineFile {
 public:
  /// Makes the file; an old one of that name is emptied.
  explicit LineFile(std::filesystem::path path);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// `line` without its end.
  void append(std::string_view line);
  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::int64_t size_ = 0;  ///< of the whole lines
};

/// Writes a file such that another reader, or a crash, sees the old one or the new one, never a part. Throws
/// as LineFile does.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// Throws what LineFile throws, for errno's value `error`.
[[noreturn]] void throw_cannot_write(const std::filesystem::path& path, int error);

}  // namespace panvo::runtime
