// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bag_file_reader.hpp"
#include "database.hpp"

namespace panvo::recorder {

/// A .db3 file, of any of rosbag2's schemas.
class SqliteFileReader final : public BagFileReader {
 public:
  /// Throws BagError: not a database, not a bag, being written, or damaged at its start.
  SqliteFileReader(std::filesystem::path file, std::vector<std::string>& warnings);

  Storage storage() const noexcept override { return Storage::kSqlite3; }
  bool damaged() const noexcept override { return salvaged_.has_value(); }
  std::uint64_t lost() const noexcept override { return lost_; }

  /// Of a sound file this reads the whole table, though not the messages.
  std::map<std::int64_t, std::uint64_t> count_by_topic() override;
  void select(std::set<std::int64_t> topic_ids, std::int64_t begin_ns) override;
  bool next(Entry& entry, interfaces::Bytes& data) override;
  /// SQLite's own check.
  std::vector<std::string> check_integrity() override;

 private:
  void read_description();
  void read_definitions();
  void read_extent();
  bool next_entry(Entry& entry);
  bool read_data(std::int64_t id, interfaces::Bytes& data);
  void salvage(const std::string& reason);

  Database database_;

  std::set<std::int64_t> wanted_;
  std::int64_t begin_ns_ = 0;  // a stamp before 1970 is damage, and would make a bag longer than numbers go
  std::optional<Entry> last_entry_;
  std::optional<Statement> entries_;  // of a sound file
  std::optional<Statement> data_;
  std::optional<std::vector<Entry>> salvaged_;  // of a damaged one, in order
  std::size_t next_salvaged_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace panvo::recorder
