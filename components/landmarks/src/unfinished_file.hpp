// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "panvo/landmarks/store_error.hpp"

namespace panvo::landmarks {

/// A temporary file that is removed on destruction unless finish() renamed it.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(const std::filesystem::path& named) : named_(named) {
    unfinished_ += ".unfinished";
    remove();  // left by a killed process
  }
  ~UnfinishedFile() { remove(); }
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  const std::filesystem::path& path() const noexcept { return unfinished_; }

  void finish() {
    std::error_code error;
    std::filesystem::rename(unfinished_, named_, error);
    end(error);
  }

  /// As finish(), but a file that has the name by now is an error.
  void finish_new() {
    std::error_code error;
    if (::renameat2(AT_FDCWD, unfinished_.c_str(), AT_FDCWD, named_.c_str(), RENAME_NOREPLACE) != 0) {
      error = {errno, std::generic_category()};
    }
    // Some file systems cannot tell in one step.
    if (error == std::errc::invalid_argument && !std::filesystem::exists(named_)) return finish();
    end(error);
  }

 private:
  void end(const std::error_code& error) const {
    if (error) throw StoreError(named_.string() + ": cannot be created (" + error.message() + "); nothing was changed");
    // Syncing the folder makes the rename durable.
    const auto folder = std::filesystem::absolute(named_).parent_path();
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0) {
      ::fsync(descriptor);
      ::close(descriptor);
    }
  }

  void remove() const noexcept {
    std::error_code ignored;
    std::filesystem::remove(unfinished_, ignored);
    std::filesystem::path journal = unfinished_;
    std::filesystem::remove(journal += "-journal", ignored);
  }

  std::filesystem::path named_;
  std::filesystem::path unfinished_ = named_;
};

}  // namespace panvo::landmarks
