// SPDX-License-Identifier: Apache-2.0
#include "seeds.hpp"

#include <fstream>

#include "../test_bag.hpp"
#include "panvo/sqlite/database.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::recorder::fuzz {

using namespace test;
using panvo::test::TemporaryFolder;

namespace {

constexpr std::uint64_t kMessages = 8;

/// The SQLite file, rewritten without free space and with small pages.
std::string packed(const std::string& file) {
  const TemporaryFolder folder;
  sqlite::Database(folder.write("bag.db3", file), sqlite::Database::Mode::kReadWrite)
      .execute("PRAGMA journal_mode=DELETE; PRAGMA page_size=512; VACUUM");
  return folder.read("bag.db3");
}

}  // namespace

std::string written(const BagWriter::Options& options, std::uint64_t messages, bool details) {
  const TemporaryFolder folder;
  {
    BagWriter writer(folder / "bag", options);
    const auto* type = details ? interfaces::find_message_type("std_msgs/msg/Header") : nullptr;
    auto headers = topic("/header", "std_msgs/msg/Header"), data = topic("/data");
    if (!details) {
      headers.offered_qos_profiles = data.offered_qos_profiles = {};
    }
    const int header = writer.add_topic(headers, type ? type->definition : "");
    const int other = writer.add_topic(data);
    for (std::uint64_t i = 0; i < messages; ++i) {
      writer.write(other, kStart + static_cast<std::int64_t>(i) * kStep, payload(i, 60));
    }
    for (std::uint64_t i = 0; i < messages / 4; ++i) {
      writer.write(header, kStart + static_cast<std::int64_t>(i) * 7 * kStep, payload(i, 30));
    }
  }
  return folder.read(options.storage == Storage::kMcap ? "bag/bag_0.mcap" : "bag/bag_0.db3");
}

std::vector<std::string> seeds(Storage storage) {
  if (storage == Storage::kSqlite3) {
    return {packed(written({.storage = storage}, kMessages)), packed(written({.storage = storage}, kMessages, false))};
  }
  std::vector<std::string> files{written({.storage = storage}, kMessages)};
  for (const auto compression : {Compression::kNone, Compression::kLz4, Compression::kZstd}) {
    files.push_back(written({.storage = storage, .compression = compression, .chunk_bytes = 300}, kMessages, false));
  }
  return files;
}

void plant_seeds(Storage storage, int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::filesystem::path folder = argv[i];
    if (!std::filesystem::is_directory(folder)) {
      continue;
    }
    const auto files = std::filesystem::is_empty(folder) ? seeds(storage) : std::vector<std::string>();
    for (std::size_t seed = 0; seed < files.size(); ++seed) {
      std::ofstream(folder / ("seed_" + std::to_string(seed)), std::ios::binary) << files[seed];
    }
    return;
  }
}

}  // namespace panvo::recorder::fuzz
