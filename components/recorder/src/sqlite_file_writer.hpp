// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>

#include "bag_file_writer.hpp"
#include "database.hpp"

namespace panvo::recorder {

/// A .db3 file, in rosbag2's schema 4.
///
/// How it survives: with a rollback journal every message is written once, into the database itself, and between
/// commits nothing that belongs to the bag is anywhere else, so that tools that know the .db3 only read all of it. (A
/// write-ahead log writes every image twice and keeps the newest part in a file that gets lost when bags are copied.)
/// The journal of a commit is small, as appending changes few old pages.
class SqliteFileWriter final : public BagFileWriter {
 public:
  SqliteFileWriter(const std::filesystem::path& file, const std::string& ros_distro);

  void begin() override { database_->execute("BEGIN"); }
  void add_topic(int id, const BagTopic& topic, const TypeDefinition& definition) override;
  void insert(int topic_id, std::int64_t timestamp_ns, std::span<const std::uint8_t> data) override;
  void insert_metadata(const std::string& yaml) override;
  void commit() override { database_->execute("COMMIT"); }
  void rollback() noexcept override;
  void finish() override;

 private:
  std::optional<Database> database_;  // none once finished
  std::optional<Statement> insert_;   // made once the tables are there
  std::set<std::string> defined_types_;
};

}  // namespace panvo::recorder
