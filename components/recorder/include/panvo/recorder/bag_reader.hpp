// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "panvo/interfaces/message_type.hpp"
#include "panvo/recorder/bag_error.hpp"
#include "panvo/recorder/bag_metadata.hpp"

namespace panvo::recorder {

/// Whether `path` looks like a bag: a .db3 or .mcap file, also compressed, or a folder with one or with metadata.yaml.
bool is_bag(const std::filesystem::path& path);

struct BagMessage {
  std::size_t topic = 0;          ///< index into BagReader::metadata().topics
  std::int64_t timestamp_ns = 0;  ///< recording time, ns since 1970
  interfaces::Bytes data;         ///< CDR with its encapsulation
};

/// Reads a rosbag2 folder or a single .db3 or .mcap file written by ROS 2 Dashing to Jazzy or by BagWriter. Supports
/// zstd compression by file (decompressed to $TMPDIR) and by message.
///
/// Recoverable faults become warnings: metadata.yaml missing, unreadable or stale (rebuilt from the files), a missing
/// file of a split bag, a truncated or damaged file (readable messages are read, losses counted). Other faults throw a
/// BagError that names the file and the remedy: not a bag, a ROS 1 bag, another compression.
///
/// Memory is bounded. SQLite: one message at a time, plus 24 bytes for each message of a damaged database. MCAP: the
/// chunks that overlap the current time.
class BagReader {
 public:
  /// kMetadata: use the counts of metadata.yaml if it agrees with the files. kFiles: always count the messages.
  enum class Trust { kMetadata, kFiles };

  explicit BagReader(const std::filesystem::path& bag, Trust trust = Trust::kMetadata);
  ~BagReader();
  BagReader(const BagReader&) = delete;
  BagReader& operator=(const BagReader&) = delete;

  /// Metadata of the whole bag, consistent with its files.
  const BagMetadata& metadata() const noexcept { return metadata_; }
  const std::filesystem::path& path() const noexcept { return bag_; }
  std::uint64_t size_bytes() const;

  /// Restarts next() and restricts it to topics accepted by `wanted` and to times from `begin_ns` on.
  void select(const std::function<bool(const BagTopic&)>& wanted, std::int64_t begin_ns = INT64_MIN);

  /// Returns the next message, ordered by timestamp, then file, then id; nullptr at the end. Valid until the following
  /// call; the caller may move the data out.
  BagMessage* next();

  /// Definition of a topic's type; empty if the bag has none.
  TypeDefinition definition(const BagTopic& topic) const;

  /// Recorded messages known to be unreadable so far. Grows as next() meets damage.
  std::uint64_t lost_messages() const;

  /// Warnings so far; each names its file.
  const std::vector<std::string>& warnings() const noexcept { return warnings_; }

  /// Faults of the files found by SQLite's integrity check or MCAP's checksums and counts. Reads all data.
  std::vector<std::string> check_integrity();

 private:
  struct File;

  void open_file(const std::filesystem::path& file);
  void describe(const std::optional<BagMetadata>& written);
  bool agrees(const BagMetadata& written) const;
  void count_messages();

  std::filesystem::path bag_;
  std::filesystem::path folder_;  // contains the files: bag_, or the parent of a single file
  BagMetadata metadata_;
  std::vector<std::unique_ptr<File>> files_;
  std::vector<std::string> warnings_;
  std::uint64_t lost_by_count_ = 0;  // excess of metadata.yaml's count if a file is damaged or missing
  BagMessage message_;
};

/// Expands "sensor_msgs/Image", the form in early bags, to "sensor_msgs/msg/Image".
std::string full_type_name(const std::string& type);

}  // namespace panvo::recorder
