// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace panvo::recorder {

/// A file of a bag could not be written; the message is that of the storage or of the operating system.
class StorageError : public std::runtime_error {
 public:
  StorageError(const std::string& what, bool is_disk) : std::runtime_error(what), is_disk_(is_disk) {}

  /// Whether more space or another disk would help.
  bool is_disk() const noexcept { return is_disk_; }

 private:
  bool is_disk_;
};

}  // namespace panvo::recorder
