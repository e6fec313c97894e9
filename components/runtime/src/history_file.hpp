// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "panvo/runtime/sample.hpp"

namespace panvo::runtime {

/// Messages of a latched topic that keeps all of them, in an unnamed file that ends with the process: only readers that
/// come later need them. Reading is thread-safe.
class HistoryFile {
 public:
  struct Place {
    std::uint64_t offset = 0;
    std::size_t size = 0;
  };

  /// Creates the file in `folder`. Throws std::system_error.
  explicit HistoryFile(const std::filesystem::path& folder);
  ~HistoryFile();
  HistoryFile(const HistoryFile&) = delete;
  HistoryFile& operator=(const HistoryFile&) = delete;

  /// Throws std::system_error, e.g. on a full disk; what was written before stays readable.
  Place append(std::span<const std::uint8_t> bytes);

  /// Throws interfaces::DecodeError if the bytes can no longer be read.
  Sample::Bytes read(Place place) const;

 private:
  int file_;
  std::uint64_t end_ = 0;
};

/// $TMPDIR, or /var/tmp, which is on a disk.
std::filesystem::path history_folder();

}  // namespace panvo::runtime
