// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "panvo/interfaces/message_type.hpp"
#include "panvo/recorder/bag_metadata.hpp"
#include "panvo/recorder/storage.hpp"

namespace panvo::recorder {

/// Content of one file of a bag, except its messages.
struct FileContent {
  std::map<std::int64_t, BagTopic> topics;            ///< by id
  std::map<std::string, TypeDefinition> definitions;  ///< by type
  std::optional<BagMetadata> stored_metadata;         ///< the file's copy of metadata.yaml, if any
  std::string ros_distro;
  std::uint64_t message_count = 0;
  std::int64_t first_ns = BagMetadata::kNoStart;  ///< BagMetadata::kNoStart if the file is empty
  std::int64_t last_ns = BagMetadata::kNoStart;
};

/// Reads one file of a bag, in any storage. A truncated or damaged file is read as far as possible.
class BagFileReader {
 public:
  struct Entry {
    std::int64_t timestamp_ns = 0;
    std::int64_t id = 0;  ///< increases in recording order
    std::int64_t topic_id = 0;
    auto operator<=>(const Entry&) const = default;
  };

  virtual ~BagFileReader() = default;
  BagFileReader(const BagFileReader&) = delete;
  BagFileReader& operator=(const BagFileReader&) = delete;

  const std::filesystem::path& path() const noexcept { return path_; }
  const FileContent& content() const noexcept { return content_; }

  virtual Storage storage() const noexcept = 0;
  /// Whether the file is known to be damaged. Damage within it may be found later.
  virtual bool damaged() const noexcept = 0;
  /// Recorded messages known to be unreadable so far.
  virtual std::uint64_t lost() const noexcept = 0;

  /// Number of messages by topic id.
  virtual std::map<std::int64_t, std::uint64_t> count_by_topic() = 0;

  /// Restarts next(), restricted to these topics and to times from `begin_ns` on.
  virtual void select(std::set<std::int64_t> topic_ids, std::int64_t begin_ns) = 0;
  /// Reads the next message in order of timestamp, then id. Returns false at the end. Unreadable messages are counted
  /// and skipped.
  virtual bool next(Entry& entry, interfaces::Bytes& data) = 0;

  /// Reads all data. Returns the faults, each with the file's name.
  virtual std::vector<std::string> check_integrity() = 0;

 protected:
  BagFileReader(std::filesystem::path path, std::vector<std::string>& warnings)
      : path_(std::move(path)), warnings_(warnings) {}

  const std::filesystem::path path_;
  std::vector<std::string>& warnings_;  // the bag's
  FileContent content_;
};

/// Opens a file of a bag; its first bytes determine the format. The reader keeps the reference to `warnings` and
/// appends to it. Throws BagError if it is not a file of a bag, is being written or is damaged at its start.
std::unique_ptr<BagFileReader> open_bag_file(const std::filesystem::path& file, std::vector<std::string>& warnings);

}  // namespace panvo::recorder
