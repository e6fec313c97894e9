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

/// What one file of a bag holds, apart from its messages.
struct FileContent {
  std::map<std::int64_t, BagTopic> topics;            ///< by id
  std::map<std::string, TypeDefinition> definitions;  ///< by type
  std::optional<BagMetadata> stored_metadata;         ///< a copy of metadata.yaml, where the file keeps one
  std::string ros_distro;
  std::uint64_t message_count = 0;
  std::int64_t first_ns = BagMetadata::kNoStart;  ///< BagMetadata::kNoStart of an empty file
  std::int64_t last_ns = BagMetadata::kNoStart;
};

/// One file of a bag being read, whatever its storage. A file that is cut off or damaged is read as far as it goes.
class BagFileReader {
 public:
  struct Entry {
    std::int64_t timestamp_ns = 0;
    std::int64_t id = 0;  ///< rises in the order in which the messages were recorded
    std::int64_t topic_id = 0;
    auto operator<=>(const Entry&) const = default;
  };

  virtual ~BagFileReader() = default;
  BagFileReader(const BagFileReader&) = delete;
  BagFileReader& operator=(const BagFileReader&) = delete;

  const std::filesystem::path& path() const noexcept { return path_; }
  const FileContent& content() const noexcept { return content_; }

  virtual Storage storage() const noexcept = 0;
  /// Whether the file is known to be damaged; damage within may come to light later.
  virtual bool damaged() const noexcept = 0;
  /// Messages that were recorded and cannot be read, as far as is known now.
  virtual std::uint64_t lost() const noexcept = 0;

  /// Messages by topic id.
  virtual std::map<std::int64_t, std::uint64_t> count_by_topic() = 0;

  /// From now on next() begins anew, with these topics only, and with messages from `begin_ns` on.
  virtual void select(std::set<std::int64_t> topic_ids, std::int64_t begin_ns) = 0;
  /// The next message in order of timestamp, then id; false at the end. Messages that cannot be read are counted and
  /// passed over.
  virtual bool next(Entry& entry, interfaces::Bytes& data) = 0;

  /// Reads everything; what is wrong with it, each line with the file's name.
  virtual std::vector<std::string> check_integrity() = 0;

 protected:
  BagFileReader(std::filesystem::path path, std::vector<std::string>& warnings)
      : path_(std::move(path)), warnings_(warnings) {}

  const std::filesystem::path path_;
  std::vector<std::string>& warnings_;  // the bag's
  FileContent content_;
};

/// Opens a file of a bag by what its first bytes say it is. Keeps `warnings` and adds to them. Throws BagError: no
/// file of a bag, being written, or damaged at its start.
std::unique_ptr<BagFileReader> open_bag_file(const std::filesystem::path& file, std::vector<std::string>& warnings);

}  // namespace panvo::recorder
