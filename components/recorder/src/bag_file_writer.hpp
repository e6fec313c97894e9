// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "database.hpp"
#include "panvo/recorder/bag_metadata.hpp"

namespace panvo::recorder {

/// One .db3 file being written, in rosbag2's schema 4. Throws DatabaseError; what to make of it is the caller's
/// business.
///
/// How it survives: with a rollback journal every message is written once, into the database itself, and between
/// commits nothing that belongs to the bag is anywhere else, so that tools that know the .db3 only read all of it. (A
/// write-ahead log writes every image twice and keeps the newest part in a file that gets lost when bags are copied.)
/// The journal of a commit is small, as appending changes few old pages.
class BagFileWriter {
 public:
  BagFileWriter(const std::filesystem::path& file, const std::string& ros_distro);

  void begin() { database_.execute("BEGIN"); }
  void add_topic(int id, const BagTopic& topic, std::string_view definition);
  void insert(int topic_id, std::int64_t timestamp_ns, std::span<const std::uint8_t> data);
  void insert_metadata(const std::string& yaml);
  void commit() { database_.execute("COMMIT"); }
  void rollback() noexcept;

  const std::filesystem::path& path() const noexcept { return path_; }
  /// Committed and, at most, a journal's worth more.
  std::uint64_t size_bytes() const;

 private:
  std::filesystem::path path_;
  Database database_;
  std::optional<Statement> insert_;  // made once the tables are there
  std::set<std::string> defined_types_;
};

}  // namespace panvo::recorder
