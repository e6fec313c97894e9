// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdlib.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <system_error>

namespace panvo::test {

/// A new, empty folder with a unique name; the destructor removes it with its content. Tests that run at the same time,
/// also in several processes, never share one.
class TemporaryFolder {
 public:
  /// In `parent`. Throws std::runtime_error if the folder cannot be created.
  explicit TemporaryFolder(const std::filesystem::path& parent = std::filesystem::temp_directory_path()) {
    std::string name = (parent / "panvo_test_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      const std::string reason = std::generic_category().message(errno);
      throw std::runtime_error("cannot create a temporary folder in " + parent.string() + ": " + reason);
    }
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const noexcept { return path_; }
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

  /// Writes `content`, byte for byte, and creates the folders above the file. Returns the file's path. Throws
  /// std::runtime_error if it cannot be written.
  std::filesystem::path write(const std::filesystem::path& name, const std::string& content) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream stream(file, std::ios::binary);
    stream << content;
    if (!stream.flush()) throw std::runtime_error("cannot write " + file.string());
    return file;
  }

  /// Contents of a file; empty if it does not exist.
  std::string read(const std::filesystem::path& name) const {
    std::ifstream stream(path_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

 private:
  std::filesystem::path path_;
};

}  // namespace panvo::test
