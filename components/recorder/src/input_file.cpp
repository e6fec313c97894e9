// SPDX-License-Identifier: Apache-2.0
#include "input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "panvo/recorder/bag_error.hpp"

namespace panvo::recorder {

InputFile::InputFile(const std::filesystem::path& path) : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  struct stat status {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) {
    const int error = errno;
    if (descriptor_ >= 0) {
      ::close(descriptor_);
    }
    throw BagError(path.string() + ": cannot be opened (" + std::strerror(error) + ")");
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() { ::close(descriptor_); }

std::size_t InputFile::read(std::uint64_t offset, std::span<std::uint8_t> bytes) const noexcept {
  std::size_t done = 0;
  while (done < bytes.size() && offset + done < size_) {
    const auto result =
        ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (result < 0 && errno == EINTR) {
      continue;
    }
    if (result <= 0) {
      break;
    }
    done += static_cast<std::size_t>(result);
  }
  return done;
}

interfaces::Bytes InputFile::read(std::uint64_t offset, std::uint64_t count) const {
  interfaces::Bytes bytes(offset < size_ ? std::min(count, size_ - offset) : 0);
  bytes.resize(read(offset, std::span(bytes)));
  return bytes;
}

}  // namespace panvo::recorder
