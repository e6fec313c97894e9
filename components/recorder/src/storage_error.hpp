// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace panvo::recorder {

/// A file of a bag could not be written: what the storage or the operating system says of it.
class StorageError : public std::runtime_error {
 public:
  StorageError(const std::string& what, bool is_disk) : std::runtime_error(what), is_disk_(is_disk) {}

  /// Whether another disk, or more room on this one, would help.
  bool is_disk() const noexcept { return is_disk_; }

 private:
  bool is_disk_;
};

}  // namespace panvo::recorder
