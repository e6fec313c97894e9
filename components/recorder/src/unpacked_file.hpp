// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace panvo::recorder {

/// Temporary decompressed copy of a zstd file in $TMPDIR, removed by the destructor. For a truncated or damaged file,
/// the data before the fault.
class UnpackedFile {
 public:
  /// Throws BagError that names the file if it cannot be decompressed to $TMPDIR, e.g. for lack of space.
  explicit UnpackedFile(const std::filesystem::path& packed);
  ~UnpackedFile();
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  void unpack(const std::filesystem::path& packed);

  std::filesystem::path folder_, path_;
};

}  // namespace panvo::recorder
