// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "database.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "panvo/recorder/bag_metadata.hpp"

namespace panvo::recorder {

/// One .db3 file being read, of any of rosbag2's schemas. A file that is cut off or damaged is read as far as it goes.
class BagFileReader {
 public:
  struct Entry {
    std::int64_t timestamp_ns = 0;
    std::int64_t id = 0;
    std::int64_t topic_id = 0;
    auto operator<=>(const Entry&) const = default;
  };

  /// Throws BagError: not a database, not a bag, compressed, MCAP, being written, or damaged at its start. Keeps
  /// `warnings` and adds to them.
  BagFileReader(std::filesystem::path file, std::vector<std::string>& warnings);

  const std::filesystem::path& path() const noexcept { return path_; }
  const std::map<std::int64_t, BagTopic>& topics() const noexcept { return topics_; }  ///< by id
  const std::optional<BagMetadata>& stored_metadata() const noexcept { return stored_metadata_; }
  const std::string& ros_distro() const noexcept { return ros_distro_; }

  std::uint64_t message_count() const noexcept { return message_count_; }
  std::int64_t first_ns() const noexcept { return first_ns_; }  ///< BagMetadata::kNoStart of an empty file
  std::int64_t last_ns() const noexcept { return last_ns_; }
  bool damaged() const noexcept { return salvaged_.has_value(); }
  std::uint64_t lost() const noexcept { return lost_; }

  /// Messages by topic id. Of a sound file this reads the whole table, though not the messages.
  std::map<std::int64_t, std::uint64_t> count_by_topic();

  /// From now on next() begins anew, with these topics only.
  void select(std::set<std::int64_t> topic_ids);
  /// The next message in order of timestamp, then id; false at the end. Messages that cannot be read are counted and
  /// passed over.
  bool next(Entry& entry, interfaces::Bytes& data);

  std::vector<std::string> check_integrity();

 private:
  void read_description();
  void read_extent();
  bool next_entry(Entry& entry);
  bool read_data(std::int64_t id, interfaces::Bytes& data);
  void salvage(const std::string& reason);

  std::filesystem::path path_;
  std::vector<std::string>& warnings_;
  Database database_;
  std::map<std::int64_t, BagTopic> topics_;
  std::optional<BagMetadata> stored_metadata_;
  std::string ros_distro_;
  std::uint64_t message_count_ = 0;
  std::int64_t first_ns_ = BagMetadata::kNoStart, last_ns_ = BagMetadata::kNoStart;

  std::set<std::int64_t> wanted_;
  std::optional<Entry> last_entry_;
  std::optional<Statement> entries_;  // of a sound file
  std::optional<Statement> data_;
  std::optional<std::vector<Entry>> salvaged_;  // of a damaged one, in order
  std::size_t next_salvaged_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace panvo::recorder
