// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace panvo::recorder {

/// Owns a file descriptor.
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

/// Locks a folder until the descriptor is closed or the process ends. Throws BagError if another process has locked it.
Descriptor lock_folder(const std::filesystem::path& folder);

/// Detects that a file being written was removed, moved or replaced, and preserves its content.
class FileGuard {
 public:
  /// Throws StorageError if the file does not exist.
  explicit FileGuard(std::filesystem::path file);

  /// Returns "was removed while ..." or similar; nullopt while the path refers to the opened file.
  std::optional<std::string> find_loss() const;

  /// Returns the path of the written data: the new path of a moved file; for a removed file, a copy at the old path, or
  /// beside it if that path is taken. Call only after the file has been closed. Throws
  /// std::filesystem::filesystem_error.
  std::filesystem::path keep() const;

 private:
  std::filesystem::path file_;
  Descriptor descriptor_;  // O_PATH: closing it does not release SQLite's locks on the file
};

}  // namespace panvo::recorder
