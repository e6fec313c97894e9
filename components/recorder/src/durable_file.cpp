// SPDX-License-Identifier: Apache-2.0
#include "durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "file_guard.hpp"
#include "panvo/recorder/bag_error.hpp"

namespace panvo::recorder {
namespace {

bool write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const auto written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written <= 0) {
      return false;
    }
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

void replace_file(const std::filesystem::path& file, std::string_view content, bool durable) {
  auto temporary = file;
  temporary += ".tmp";
  Descriptor descriptor(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (descriptor.get() < 0 || !write_all(descriptor.get(), content) || (durable && ::fsync(descriptor.get()) != 0) ||
      !descriptor.close() || ::rename(temporary.c_str(), file.c_str()) != 0) {
    const int error = errno;
    ::unlink(temporary.c_str());
    throw BagError(file.string() + ": cannot be written (" + std::strerror(error) + ")");
  }
  if (durable) {
    sync_folder(file.parent_path());
  }
}

void sync_folder(const std::filesystem::path& folder) noexcept {
  const Descriptor descriptor(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.get() >= 0) {
    ::fsync(descriptor.get());
  }
}

}  // namespace panvo::recorder
