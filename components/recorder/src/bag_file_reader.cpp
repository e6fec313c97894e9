// SPDX-License-Identifier: Apache-2.0
#include "bag_file_reader.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include "mcap/mcap_file_reader.hpp"
#include "panvo/recorder/bag_error.hpp"
#include "sqlite_file_reader.hpp"
#include "unpacked_file.hpp"

namespace panvo::recorder {
namespace {

namespace fs = std::filesystem;

enum class Kind { kSqlite, kMcap, kZstd };

std::string first_bytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw BagError(file.string() + ": cannot be opened (" + std::strerror(errno) + ")");
  }
  std::array<char, 16> bytes{};
  stream.read(bytes.data(), bytes.size());
  return {bytes.data(), static_cast<std::size_t>(stream.gcount())};
}

Kind kind_of(const fs::path& file) {
  using namespace std::string_view_literals;
  if (fs::is_directory(file)) {
    throw BagError(file.string() + ": is a folder, not a file of a bag");
  }
  const auto start = first_bytes(file);
  if (start.empty()) {
    throw BagError(file.string() + ": is empty; if it belongs to a bag, delete it and run `panvo bag reindex`");
  }
  if (start.starts_with("SQLite format 3\0"sv)) {
    return Kind::kSqlite;
  }
  if (start.starts_with("\x89MCAP"sv)) {
    return Kind::kMcap;
  }
  if (start.starts_with("\x28\xb5\x2f\xfd"sv)) {
    return Kind::kZstd;
  }
  if (start.starts_with("#ROSBAG"sv)) {
    throw BagError(file.string() + ": is a ROS 1 bag; convert it to ROS 2 with `rosbags-convert`");
  }
  if (file.extension() == ".mcap") {
    return Kind::kMcap;  // the first bytes are damaged; others may be readable
  }
  throw BagError(file.string() +
                 ": is neither a SQLite database nor MCAP (or its first bytes are damaged); specify a rosbag2 folder "
                 "or a bag file");
}

/// Reads a compressed file through a temporary decompressed copy.
class PackedFileReader final : public BagFileReader {
 public:
  PackedFileReader(const fs::path& file, std::vector<std::string>& warnings)
      : BagFileReader(file, warnings), unpacked_(file), reader_(open(warnings)) {
    content_ = reader_->content();
    name_packed_file();
  }

  Storage storage() const noexcept override { return reader_->storage(); }
  bool damaged() const noexcept override { return reader_->damaged(); }
  std::uint64_t lost() const noexcept override { return reader_->lost(); }
  std::map<std::int64_t, std::uint64_t> count_by_topic() override { return reader_->count_by_topic(); }
  void select(std::set<std::int64_t> topic_ids, std::int64_t begin_ns) override {
    reader_->select(std::move(topic_ids), begin_ns);
  }
  bool next(Entry& entry, interfaces::Bytes& data) override {
    const bool is_read = reader_->next(entry, data);
    name_packed_file();
    return is_read;
  }
  std::vector<std::string> check_integrity() override { return reader_->check_integrity(); }

 private:
  std::unique_ptr<BagFileReader> open(std::vector<std::string>& warnings) const {
    try {
      if (kind_of(unpacked_.path()) != Kind::kZstd) {
        return open_bag_file(unpacked_.path(), warnings);
      }
    } catch (const BagError& error) {
      throw BagError(path_.string() + ": the compressed content cannot be read: " + error.what());
    }
    throw BagError(path_.string() + ": is compressed twice; decompress it with `zstd -d`");
  }

  /// Replaces the path of the temporary copy by that of the compressed file in new warnings.
  void name_packed_file() {
    for (; warnings_seen_ < warnings_.size(); ++warnings_seen_) {
      auto& warning = warnings_[warnings_seen_];
      if (warning.starts_with(unpacked_.path().string())) {
        warning.replace(0, unpacked_.path().string().size(), path_.string());
      }
    }
  }

  UnpackedFile unpacked_;
  std::size_t warnings_seen_ = 0;
  std::unique_ptr<BagFileReader> reader_;
};

}  // namespace

std::unique_ptr<BagFileReader> open_bag_file(const fs::path& file, std::vector<std::string>& warnings) {
  switch (kind_of(file)) {
    case Kind::kMcap:
      return std::make_unique<mcap::McapFileReader>(file, warnings);
    case Kind::kZstd:
      return std::make_unique<PackedFileReader>(file, warnings);
    case Kind::kSqlite:
      break;
  }
  return std::make_unique<SqliteFileReader>(file, warnings);
}

}  // namespace panvo::recorder
