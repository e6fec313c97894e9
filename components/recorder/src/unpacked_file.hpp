// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace panvo::recorder {

/// What a file that is compressed with zstd holds, in the folder for temporary files ($TMPDIR), and gone with this
/// object. Of a file that is cut off or damaged, what comes before that.
class UnpackedFile {
 public:
  /// Throws BagError naming the file: it cannot be read, or there is no room.
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
