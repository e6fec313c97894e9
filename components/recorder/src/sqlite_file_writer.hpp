// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>

#include "bag_file_writer.hpp"
#include "panvo/sqlite/database.hpp"

namespace panvo::recorder {

/// Writes a .db3 file in rosbag2's schema 4.
///
/// Uses a rollback journal: each message is written once, directly into the database, and between commits the .db3
/// alone is complete, so that other tools can read it. A write-ahead log would write each image twice and keep the
/// newest part in a second file, which is easily lost when a bag is copied. The journal of a commit is small, since
/// appending changes few existing pages.
class SqliteFileWriter final : public BagFileWriter {
 public:
  SqliteFileWriter(const std::filesystem::path& file, const std::string& ros_distro);

  void begin() override;
  void add_topic(int id, const BagTopic& topic, const TypeDefinition& definition) override;
  void insert(int topic_id, std::int64_t timestamp_ns, std::span<const std::uint8_t> data) override;
  void insert_metadata(const std::string& yaml) override;
  void commit() override;
  void rollback() noexcept override;
  void finish() override;

 private:
  std::optional<sqlite::Database> database_;  // empty after finish()
  std::optional<sqlite::Statement> insert_;   // prepared after the tables have been created
  std::set<std::string> defined_types_;
};

}  // namespace panvo::recorder
