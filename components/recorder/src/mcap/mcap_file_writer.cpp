// SPDX-License-Identifier: Apache-2.0
#include "mcap_file_writer.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <utility>

#include "compression.hpp"
#include "crc32.hpp"

namespace panvo::recorder::mcap {
namespace {

[[noreturn]] void fail_with(int error) {
  const bool is_disk = error == ENOSPC || error == EDQUOT || error == EFBIG || error == EIO || error == EROFS;
  throw StorageError(std::strerror(error), is_disk);
}

}  // namespace

McapFileWriter::McapFileWriter(const std::filesystem::path& file, const Options& options)
    : BagFileWriter(file),
      options_(options),
      descriptor_(::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) {
    fail_with(errno);
  }
  outside_.assign(kMagic.begin(), kMagic.end());
  append(outside_, Header{.profile = "ros2", .library = "panvo"});
}

McapFileWriter::~McapFileWriter() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

void McapFileWriter::add_topic(int id, const BagTopic& topic, const TypeDefinition& definition) {
  constexpr std::size_t kMaxIds = std::numeric_limits<std::uint16_t>::max();
  if (static_cast<std::size_t>(id) > kMaxIds || schemas_.size() >= kMaxIds) {
    throw StorageError("MCAP files have at most " + std::to_string(kMaxIds) + " topics; record fewer", false);
  }
  auto schema = std::find_if(schemas_.begin(), schemas_.end(), [&](const Schema& s) { return s.name == topic.type; });
  if (schema == schemas_.end()) {
    const bool is_known = !definition.text.empty() && definition.encoding != "unknown";
    schemas_.push_back({.id = static_cast<std::uint16_t>(schemas_.size() + 1),
                        .name = topic.type,
                        .encoding = is_known ? definition.encoding : "",
                        .data = is_known ? definition.text : ""});
    schema = std::prev(schemas_.end());
    append(outside_, *schema);
  }
  channels_.push_back({.id = static_cast<std::uint16_t>(id),
                       .schema_id = schema->id,
                       .topic = topic.name,
                       .message_encoding = topic.serialization_format,
                       .metadata = {{"offered_qos_profiles", to_text(topic.offered_qos_profiles, QosNotation::kNames)},
                                    {"topic_type_hash", topic.type_description_hash}}});
  append(outside_, channels_.back());
  statistics_.messages_by_channel[static_cast<std::uint16_t>(id)] = 0;
}

void McapFileWriter::insert(int topic_id, std::int64_t timestamp_ns, std::span<const std::uint8_t> data) {
  if (timestamp_ns < 0) {
    throw StorageError("a message was recorded at " + std::to_string(timestamp_ns) +
                           " ns, before 1970, which MCAP cannot represent; choose the storage sqlite3",
                       false);
  }
  const auto channel = static_cast<std::uint16_t>(topic_id);
  const auto time = static_cast<std::uint64_t>(timestamp_ns);
  if (!records_.empty() && records_.size() + data.size() > options_.chunk_bytes) {
    write_chunk();
  }
  chunk_start_ = records_.empty() ? time : std::min(chunk_start_, time);
  chunk_end_ = records_.empty() ? time : std::max(chunk_end_, time);
  auto& index = indexes_[channel];
  index.channel = channel;
  index.entries.emplace_back(time, records_.size());
  append(records_, {.channel = channel, .sequence = sequences_[channel]++, .log_time = time, .publish_time = time},
         data);
  const bool is_first = statistics_.message_count++ == 0;
  statistics_.start_time = is_first ? time : std::min(statistics_.start_time, time);
  statistics_.end_time = is_first ? time : std::max(statistics_.end_time, time);
  ++statistics_.messages_by_channel[channel];
}

void McapFileWriter::insert_metadata(const std::string& yaml) {
  write_chunk();
  const auto before = outside_.size();
  append(outside_, Metadata{.name = "rosbag2", .values = {{"serialized_metadata", yaml}}});
  metadata_.push_back({.offset = size_ + before, .length = outside_.size() - before, .name = "rosbag2"});
}

void McapFileWriter::commit() {
  write_chunk();
  write(std::exchange(outside_, {}));
  sync();
}

/// If there are messages, writes the pending records, the chunk and its indexes.
void McapFileWriter::write_chunk() {
  if (records_.empty()) {
    return;
  }
  write(std::exchange(outside_, {}));
  const bool is_compressed = options_.compression != Compression::kNone;
  const auto compressed = is_compressed ? compress(options_.compression, records_) : Bytes();
  const ByteSpan stored = is_compressed ? compressed : records_;
  const ChunkHead head{.start_time = chunk_start_,
                       .end_time = chunk_end_,
                       .uncompressed_size = records_.size(),
                       .crc = crc32(records_),
                       .compression = std::string(name_of(options_.compression)),
                       .records_size = stored.size()};
  ChunkIndex index{.start_time = chunk_start_,
                   .end_time = chunk_end_,
                   .offset = size_,
                   .length = RecordHead::kBytes + head.bytes() + stored.size(),
                   .compression = head.compression,
                   .compressed_size = stored.size(),
                   .uncompressed_size = records_.size()};
  Bytes around;
  append(around, head);
  write(around);
  write(stored);
  around.clear();
  for (const auto& [channel, messages] : indexes_) {
    index.message_index_offsets[channel] = size_ + around.size();
    append(around, messages);
  }
  index.message_index_length = around.size();
  write(around);
  chunks_.push_back(std::move(index));
  records_.clear();
  indexes_.clear();
}

void McapFileWriter::write(ByteSpan bytes) {
  while (!bytes.empty()) {
    const auto written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written <= 0) {
      fail_with(written < 0 ? errno : ENOSPC);
    }
    size_ += static_cast<std::uint64_t>(written);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void McapFileWriter::sync() {
  // EINVAL: not supported by the file system.
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL) {
    fail_with(errno);
  }
  committed_size_ = size_;
}

void McapFileWriter::rollback() noexcept {
  records_.clear();
  indexes_.clear();
  outside_.clear();
  if (descriptor_ >= 0 && ::ftruncate(descriptor_, static_cast<off_t>(committed_size_)) == 0) {
    size_ = committed_size_;
    ::lseek(descriptor_, static_cast<off_t>(size_), SEEK_SET);
  }
}

void McapFileWriter::finish() {
  write_chunk();
  append_data_end(outside_);
  write(std::exchange(outside_, {}));
  write(make_summary(size_));
  sync();
  if (::close(std::exchange(descriptor_, -1)) != 0) {
    fail_with(errno);
  }
}

/// Returns the groups of summary records, the offsets of the groups and the footer.
Bytes McapFileWriter::make_summary(std::uint64_t start) const {
  Bytes summary;
  std::vector<SummaryOffset> groups;
  const auto add_group = [&](Opcode opcode, const auto& records) {
    const auto before = summary.size();
    for (const auto& record : records) {
      append(summary, record);
    }
    if (summary.size() > before) {
      groups.push_back({.group = opcode, .start = start + before, .length = summary.size() - before});
    }
  };
  auto statistics = statistics_;
  statistics.schema_count = static_cast<std::uint16_t>(schemas_.size());
  statistics.channel_count = static_cast<std::uint32_t>(channels_.size());
  statistics.metadata_count = static_cast<std::uint32_t>(metadata_.size());
  statistics.chunk_count = static_cast<std::uint32_t>(chunks_.size());
  add_group(Opcode::kSchema, schemas_);
  add_group(Opcode::kChannel, channels_);
  add_group(Opcode::kStatistics, std::span(&statistics, 1));
  add_group(Opcode::kChunkIndex, chunks_);
  add_group(Opcode::kMetadataIndex, metadata_);
  const Footer footer{.summary_start = start, .summary_offset_start = start + summary.size()};
  for (const auto& group : groups) {
    append(summary, group);
  }
  append_footer(summary, footer);
  summary.insert(summary.end(), kMagic.begin(), kMagic.end());
  return summary;
}

}  // namespace panvo::recorder::mcap
