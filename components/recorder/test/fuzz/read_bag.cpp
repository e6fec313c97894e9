// SPDX-License-Identifier: Apache-2.0
#include "read_bag.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>

#include "panvo/recorder/bag_reader.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::recorder::fuzz {
namespace {

/// A temporary folder, in memory if possible, created once.
const std::filesystem::path& folder() {
  static const panvo::test::TemporaryFolder made(
      ::access("/dev/shm", W_OK) == 0 ? std::filesystem::path("/dev/shm") : std::filesystem::temp_directory_path());
  return made.path();
}

void write_file(const std::filesystem::path& file, const std::uint8_t* data, std::size_t size) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  while (size > 0) {
    const auto written = ::write(descriptor, data, size);
    if (written <= 0) {
      std::abort();
    }
    data += written;
    size -= static_cast<std::size_t>(written);
  }
  ::close(descriptor);
}

}  // namespace

std::size_t read_bag(const std::string& name, const std::uint8_t* data, std::size_t size) {
  const auto file = folder() / name;
  for (const char* left : {"-journal", "-wal", "-shm"}) {  // left by SQLite from the previous case
    std::error_code error;
    std::filesystem::remove(file.string() + left, error);
  }
  write_file(file, data, size);
  std::size_t count = 0;
  try {
    BagReader reader(file);
    while (reader.next()) {
      ++count;
    }
    reader.select([](const BagTopic& topic) { return topic.name.size() % 2 == 0; }, 1);
    while (reader.next()) {
    }
    reader.check_integrity();
  } catch (const BagError&) {
  }
  return count;
}

}  // namespace panvo::recorder::fuzz
