// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace panvo::recorder {

/// Closes a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int descriptor = -1) noexcept : descriptor_(descriptor) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : descriptor_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept;

  int get() const noexcept { return descriptor_; }
  int release() noexcept;
  bool close() noexcept;

 private:
  int descriptor_;
};

/// Takes a folder for this process; it is free again when the descriptor is closed, at the latest with the process. Throws BagError while another has it.
Descriptor lock_folder(const std::filesystem::path& folder);

/// Notices that a file which is being written was removed, moved or replaced, and keeps what was written to it.
class FileGuard {
 public:
  /// Throws StorageError if the file is not there.
  explicit FileGuard(std::filesystem::path file);

  /// "was removed" or the like; nullopt while the path leads to the file that was opened.
  std::optional<std::string> find_loss() const;

  /// Where what was written can be found: where the file was moved to, or, if it was removed, a copy in its place or beside what is there now.
  /// To be called when nobody else has the file open. Throws std::filesystem::filesystem_error.
  std::filesystem::path keep() const;

 private:
  std::filesystem::path file_;
  Descriptor descriptor_;  // O_PATH: closing it leaves SQLite its locks on the file
};

}  // namespace panvo::recorder
