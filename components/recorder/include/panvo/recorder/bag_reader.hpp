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

struct BagMessage {
  std::size_t topic = 0;          ///< index into BagReader::metadata().topics
  std::int64_t timestamp_ns = 0;  ///< when it was recorded
  interfaces::Bytes data;         ///< CDR, encapsulation included
};

/// Reads a rosbag2 folder, or a single .db3 or .mcap file, as written by ROS 2 Dashing to Jazzy and by BagWriter; also
/// one that is compressed with zstd, as files (which are unpacked to the folder for temporary files) or message by
/// message.
///
/// What is not as it should be but can be helped is remembered as a warning: metadata.yaml that is missing,
/// unreadable or stale (rebuilt from the files), a file of a split bag that is missing, a file that was cut off or is
/// damaged (what is readable is read, what is not is counted). What cannot be helped is a BagError that names the file
/// and the remedy: not a bag, of ROS 1, compressed in another way.
///
/// Memory is bounded: of SQLite messages are read one at a time, and of a damaged database 24 bytes a message are held;
/// of MCAP the chunks of the moment.
class BagReader {
 public:
  /// Whether to believe a metadata.yaml that agrees with the files, or to count everything anew.
  enum class Trust { kMetadata, kFiles };

  explicit BagReader(const std::filesystem::path& bag, Trust trust = Trust::kMetadata);
  ~BagReader();
  BagReader(const BagReader&) = delete;
  BagReader& operator=(const BagReader&) = delete;

  /// Of the whole bag, true to what its files hold.
  const BagMetadata& metadata() const noexcept { return metadata_; }
  const std::filesystem::path& path() const noexcept { return bag_; }
  std::uint64_t size_bytes() const;

  /// From now on next() starts anew and gives only messages of topics that `wanted` accepts, from `begin_ns` on.
  void select(const std::function<bool(const BagTopic&)>& wanted, std::int64_t begin_ns = INT64_MIN);

  /// The message after the last one, in order of timestamp, then file, then id; nullptr at the end. Valid until the
  /// following call; its data may be moved away.
  BagMessage* next();

  /// What the bag tells of a topic's type; empty where it tells nothing.
  TypeDefinition definition(const BagTopic& topic) const;

  /// Messages that were recorded but cannot be read, as far as is known now. Grows while next() meets damage.
  std::uint64_t lost_messages() const;

  /// Everything worth telling, so far; each names its file.
  const std::vector<std::string>& warnings() const noexcept { return warnings_; }

  /// What is wrong with the files, by SQLite's own check or MCAP's checksums and counts. Reads everything.
  std::vector<std::string> check_integrity();

 private:
  struct File;

  void open_file(const std::filesystem::path& file);
  void describe(const std::optional<BagMetadata>& written);
  bool agrees(const BagMetadata& written) const;
  void count_messages();

  std::filesystem::path bag_;
  std::filesystem::path folder_;  // of the files: bag_, or where the single file lies
  BagMetadata metadata_;
  std::vector<std::unique_ptr<File>> files_;
  std::vector<std::string> warnings_;
  std::uint64_t lost_by_count_ = 0;  // what metadata.yaml counted more, where a file is damaged or missing
  BagMessage message_;
};

/// "sensor_msgs/Image", as early bags have it, is "sensor_msgs/msg/Image".
std::string full_type_name(const std::string& type);

}  // namespace panvo::recorder
