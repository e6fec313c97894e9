// SPDX-License-Identifier: Apache-2.0
#include "history_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

namespace panvo::runtime {
namespace {

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

/// -1, with errno set, if the file cannot be created.
int open_unnamed(const std::filesystem::path& folder) {
  std::string name = folder / "panvo-XXXXXX";  // for a moment: not all file systems have O_TMPFILE
  const int file = ::mkostemp(name.data(), O_CLOEXEC);
  if (file >= 0) ::unlink(name.c_str());
  return file;
}

}  // namespace

HistoryFile::HistoryFile(const std::filesystem::path& folder) : file_(open_unnamed(folder)) {
  if (file_ < 0) fail(("cannot create a file in " + folder.string()).c_str());
}

HistoryFile::~HistoryFile() { ::close(file_); }

HistoryFile::Place HistoryFile::append(std::span<const std::uint8_t> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const auto written = ::pwrite(file_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(end_ + done));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail("cannot write the file of latched messages");
    done += static_cast<std::size_t>(written);
  }
  const Place place{end_, bytes.size()};
  end_ += bytes.size();
  return place;
}

Sample::Bytes HistoryFile::read(Place place) const {
  Sample::Bytes bytes(place.size);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const auto got = ::pread(file_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(place.offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw interfaces::DecodeError("cannot be read back from the file of latched messages");
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

std::filesystem::path history_folder() {
  const char* const folder = std::getenv("TMPDIR");
  return folder && *folder ? folder : "/var/tmp";
}

}  // namespace panvo::runtime
