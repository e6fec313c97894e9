// SPDX-License-Identifier: Apache-2.0
#include "file_guard.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "panvo/recorder/bag_error.hpp"
#include "storage_error.hpp"

namespace panvo::recorder {
namespace {

namespace fs = std::filesystem;

fs::path link_of(const Descriptor& descriptor) { return "/proc/self/fd/" + std::to_string(descriptor.get()); }

/// `file` if it does not exist, else the first free name with _kept and a number before the extension.
fs::path free_name(const fs::path& file) {
  fs::path name = file;
  for (int i = 1; fs::exists(name); ++i) {
    name.replace_filename(file.stem().string() + "_kept" + std::to_string(i) + file.extension().string());
  }
  return name;
}

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) {
    close();
    descriptor_ = other.release();
  }
  return *this;
}

int Descriptor::release() noexcept { return std::exchange(descriptor_, -1); }

bool Descriptor::close() noexcept {
  const int descriptor = release();
  return descriptor < 0 || ::close(descriptor) == 0;
}

Descriptor lock_folder(const fs::path& folder) {
  Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // On file systems without folder locks (some network file systems) other recorders are not detected.
  if (descriptor.get() >= 0 && ::flock(descriptor.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    throw BagError(folder.string() + ": another recorder is writing to it; choose another folder");
  }
  return descriptor;
}

FileGuard::FileGuard(fs::path file) : file_(std::move(file)), descriptor_(::open(file_.c_str(), O_PATH | O_CLOEXEC)) {
  if (descriptor_.get() < 0) {
    throw StorageError(std::strerror(errno), false);
  }
}

std::optional<std::string> FileGuard::find_loss() const {
  struct stat opened {};
  struct stat there {};
  if (::fstat(descriptor_.get(), &opened) != 0) {
    return std::nullopt;  // unknown
  }
  const bool is_there = ::stat(file_.c_str(), &there) == 0;
  if (is_there && there.st_dev == opened.st_dev && there.st_ino == opened.st_ino) {
    return std::nullopt;
  }
  const std::string how = opened.st_nlink > 0 ? "moved away" : "removed";
  return "was " + how + (is_there ? " and replaced" : "") + " while it was being recorded";
}

fs::path FileGuard::keep() const {
  struct stat opened {};
  if (::fstat(descriptor_.get(), &opened) == 0 && opened.st_nlink > 0) {
    return fs::read_symlink(link_of(descriptor_));
  }
  fs::create_directories(file_.parent_path());
  const auto name = free_name(file_);
  std::ifstream from(link_of(descriptor_), std::ios::binary);
  std::ofstream to(name, std::ios::binary | std::ios::trunc);
  if (!from || !(to << from.rdbuf()) || !to.flush()) {
    throw fs::filesystem_error("cannot be written", name, std::error_code(errno, std::generic_category()));
  }
  return name;
}

}  // namespace panvo::recorder
