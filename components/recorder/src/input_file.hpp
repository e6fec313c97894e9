// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::recorder {

/// A file with random read access. Its size is taken when it is opened.
class InputFile {
 public:
  /// Throws BagError that names the file.
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  std::uint64_t size() const noexcept { return size_; }

  /// Fills `bytes` from `offset` on. Returns the number of bytes read, fewer at the end of the file or on a disk error.
  std::size_t read(std::uint64_t offset, std::span<std::uint8_t> bytes) const noexcept;

  /// Reads at most `count` bytes. Allocates no more than the file's remaining size.
  interfaces::Bytes read(std::uint64_t offset, std::uint64_t count) const;

 private:
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace panvo::recorder
