// SPDX-License-Identifier: Apache-2.0
#include "output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <system_error>

namespace panvo::runner {
namespace {

/// Writes everything; returns 0 or the errno value.
int write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const auto written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno != EINTR) {
      return errno;
    }
    content.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
  }
  return 0;
}

int create(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) {
    throw_cannot_write(path, errno);
  }
  return descriptor;
}

}  // namespace

LineFile::LineFile(std::filesystem::path path) : path_(std::move(path)), descriptor_(create(path_)) {}

LineFile::~LineFile() { ::close(descriptor_); }

void LineFile::append(std::string_view line) {
  const std::string content = std::string(line) + "\n";
  if (const int error = write_all(descriptor_, content)) {
    // Removes the partial line. A failure here cannot be handled.
    if (::ftruncate(descriptor_, size_) == 0) {
      ::lseek(descriptor_, size_, SEEK_SET);
    }
    throw_cannot_write(path_, error);
  }
  size_ += static_cast<std::int64_t>(content.size());
}

void write_atomically(const std::filesystem::path& path, std::string_view content) {
  std::filesystem::path temporary = path;
  temporary += ".part";
  const int descriptor = create(temporary);
  int error = write_all(descriptor, content);
  if (error == 0 && ::fsync(descriptor) != 0) {
    error = errno;
  }
  if (::close(descriptor) != 0 && error == 0) {
    error = errno;
  }
  if (error == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) {
    error = errno;
  }
  if (error != 0) {
    ::unlink(temporary.c_str());
    throw_cannot_write(path, error);
  }
}

void throw_cannot_write(const std::filesystem::path& path, int error) {
  const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  throw std::runtime_error("cannot write " + path.string() + ": " + std::generic_category().message(error) +
                           (full ? "; free space there, or choose another folder (what was written so far is kept)"
                                 : "; choose a writable folder"));
}

}  // namespace panvo::runner
