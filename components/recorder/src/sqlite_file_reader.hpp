// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bag_file_reader.hpp"
#include "panvo/sqlite/database.hpp"

namespace panvo::recorder {

/// Reads a .db3 file of any rosbag2 schema.
class SqliteFileReader final : public BagFileReader {
 public:
  /// Throws BagError if it is not a database or not a bag, is being written or is damaged at its start.
  SqliteFileReader(std::filesystem::path file, std::vector<std::string>& warnings);

  Storage storage() const noexcept override { return Storage::kSqlite3; }
  bool damaged() const noexcept override { return salvaged_.has_value(); }
  std::uint64_t lost() const noexcept override { return lost_; }

  /// For an undamaged file this reads the whole table, but not the message data.
  std::map<std::int64_t, std::uint64_t> count_by_topic() override;
  void select(std::set<std::int64_t> topic_ids, std::int64_t begin_ns) override;
  bool next(Entry& entry, interfaces::Bytes& data) override;
  /// Runs SQLite's integrity check.
  std::vector<std::string> check_integrity() override;

 private:
  void read_description();
  void read_definitions();
  void read_extent();
  bool next_entry(Entry& entry);
  bool read_data(std::int64_t id, interfaces::Bytes& data);
  void salvage(const std::string& reason);

  sqlite::Database database_;

  std::set<std::int64_t> wanted_;
  std::int64_t begin_ns_ = 0;  // stamps before 1970 are damage and could overflow the duration
  std::optional<Entry> last_entry_;
  std::optional<sqlite::Statement> entries_;  // of an undamaged file
  std::optional<sqlite::Statement> data_;
  std::optional<std::vector<Entry>> salvaged_;  // of a damaged one, in order
  std::size_t next_salvaged_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace panvo::recorder
