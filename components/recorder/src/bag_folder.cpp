// SPDX-License-Identifier: Apache-2.0
#include "bag_folder.hpp"

#include "panvo/recorder/bag_error.hpp"
#include "panvo/recorder/bag_metadata.hpp"

namespace panvo::recorder {
namespace {

namespace fs = std::filesystem;

bool belongs_to_bag(const fs::path& file) {
  const auto name = file.filename().string();
  return name == kMetadataFile || name.ends_with(".db3") || name.ends_with(".db3-journal") ||
         name.ends_with(".db3-wal") || name.ends_with(".db3-shm") || name.ends_with(".mcap") ||
         name.ends_with(".db3.zstd") || name.ends_with(".mcap.zstd");
}

/// Removes the files of a bag. Throws BagError and removes nothing if the folder holds anything else.
void remove_bag(const fs::path& bag) {
  for (const auto& entry : fs::directory_iterator(bag)) {
    if (!entry.is_regular_file() || !belongs_to_bag(entry.path())) {
      throw BagError(bag.string() + ": not overwritten: it contains " + entry.path().filename().string() +
                     ", which is not part of a bag; choose another folder");
    }
  }
  for (const auto& entry : fs::directory_iterator(bag)) {
    fs::remove(entry.path());
  }
}

}  // namespace

Descriptor take_folder(const fs::path& bag, bool overwrite) {
  try {
    if (fs::exists(bag) && !fs::is_directory(bag)) {
      throw BagError(bag.string() + ": is a file, but a bag is a folder; choose another name");
    }
    fs::create_directories(bag);
    auto lock = lock_folder(bag);
    if (!fs::is_empty(bag)) {
      if (!overwrite) {
        throw BagError(bag.string() + ": already exists; choose another folder or set overwrite (--overwrite)");
      }
      remove_bag(bag);
    }
    return lock;
  } catch (const fs::filesystem_error& error) {
    throw BagError(bag.string() + ": cannot be created (" + error.code().message() + "); choose a writable folder");
  }
}

std::string dated_bag_name() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[64];
  std::strftime(text, sizeof text, "rosbag2_%Y_%m_%d-%H_%M_%S", &local);
  return text;
}

}  // namespace panvo::recorder
