// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::recorder {

/// A file that is read from any place of it. It counts as being as long as it was when it was opened.
class InputFile {
 public:
  /// Throws BagError naming the file.
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  std::uint64_t size() const noexcept { return size_; }

  /// Fills `bytes` from `offset` on; returns how many there are, fewer at the file's end or where the disk fails.
  std::size_t read(std::uint64_t offset, std::span<std::uint8_t> bytes) const noexcept;

  /// At most `count` bytes: no more memory is taken than the file has bytes.
  interfaces::Bytes read(std::uint64_t offset, std::uint64_t count) const;

 private:
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace panvo::recorder
