// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>

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
    if (error) throw StoreError(named_.string() + ": cannot be created (" + error.message() + "); nothing was changed");
    // Syncing the folder makes the rename durable.
    const auto folder = std::filesystem::absolute(named_).parent_path();
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0) {
      ::fsync(descriptor);
      ::close(descriptor);
    }
  }

 private:
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
