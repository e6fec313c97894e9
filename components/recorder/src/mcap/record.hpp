// SPDX-License-Identifier: Apache-2.0
/// The records of an MCAP file: a one-byte opcode, an eight-byte length and the content. parse_...() read the content
/// and throw FormatError; append() appends whole records.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "bytes.hpp"

namespace panvo::recorder::mcap {

using interfaces::Bytes;
using ByteSpan = std::span<const std::uint8_t>;

inline constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
  kFirstPrivate = 0x80  ///< first opcode of private records, which readers skip
};

struct RecordHead {
  static constexpr std::size_t kBytes = 9;
  Opcode opcode{};
  std::uint64_t length = 0;  ///< of the content

  bool is_known() const noexcept {
    return (opcode >= Opcode::kHeader && opcode <= Opcode::kDataEnd) || opcode >= Opcode::kFirstPrivate;
  }
};

struct Header {
  std::string profile, library;
};

struct Schema {
  std::uint16_t id = 0;
  std::string name, encoding, data;
};

struct Channel {
  std::uint16_t id = 0, schema_id = 0;
  std::string topic, message_encoding;
  std::map<std::string, std::string> metadata;
};

/// The header of a Message record, before the data.
struct MessageHead {
  static constexpr std::size_t kBytes = 22;
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0, publish_time = 0;
};

/// The header of a Chunk record, before the records.
struct ChunkHead {
  std::uint64_t start_time = 0, end_time = 0, uncompressed_size = 0;
  std::uint32_t crc = 0;  ///< of the uncompressed records; 0: unknown
  std::string compression;
  std::uint64_t records_size = 0;  ///< stored size

  std::size_t bytes() const noexcept { return 40 + compression.size(); }
};

/// Offsets of a channel's messages in the preceding chunk.
struct MessageIndex {
  std::uint16_t channel = 0;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> entries;  ///< log time, offset
};

struct ChunkIndex {
  std::uint64_t start_time = 0, end_time = 0, offset = 0, length = 0;
  std::map<std::uint16_t, std::uint64_t> message_index_offsets{};  ///< by channel
  std::uint64_t message_index_length = 0;
  std::string compression;
  std::uint64_t compressed_size = 0, uncompressed_size = 0;
};

struct Statistics {
  std::uint64_t message_count = 0;
  std::uint16_t schema_count = 0;
  std::uint32_t channel_count = 0, attachment_count = 0, metadata_count = 0, chunk_count = 0;
  std::uint64_t start_time = 0, end_time = 0;
  std::map<std::uint16_t, std::uint64_t> messages_by_channel;
};

struct Metadata {
  std::string name;
  std::map<std::string, std::string> values;
};

struct MetadataIndex {
  std::uint64_t offset = 0, length = 0;
  std::string name;
};

struct SummaryOffset {
  Opcode group{};
  std::uint64_t start = 0, length = 0;
};

struct Footer {
  static constexpr std::size_t kBytes = 20;
  std::uint64_t summary_start = 0, summary_offset_start = 0;
  std::uint32_t summary_crc = 0;  ///< 0: unknown
};

RecordHead parse_record_head(ByteSpan bytes);
Header parse_header(ByteSpan content);
Schema parse_schema(ByteSpan content);
Channel parse_channel(ByteSpan content);
MessageHead parse_message_head(ByteSpan content);
/// `beginning`: at least the header of a content of `content_length` bytes. Throws FormatError if the sizes disagree.
ChunkHead parse_chunk_head(ByteSpan beginning, std::uint64_t content_length);
MessageIndex parse_message_index(ByteSpan content);
ChunkIndex parse_chunk_index(ByteSpan content);
Statistics parse_statistics(ByteSpan content);
Metadata parse_metadata_record(ByteSpan content);
Footer parse_footer(ByteSpan content);

void append(Bytes& bytes, const Header& header);
void append(Bytes& bytes, const Schema& schema);
void append(Bytes& bytes, const Channel& channel);
void append(Bytes& bytes, const MessageHead& head, ByteSpan data);
/// Appends the header only; the caller appends `records_size` bytes.
void append(Bytes& bytes, const ChunkHead& head);
void append(Bytes& bytes, const MessageIndex& index);
void append(Bytes& bytes, const ChunkIndex& index);
void append(Bytes& bytes, const Statistics& statistics);
void append(Bytes& bytes, const Metadata& metadata);
void append(Bytes& bytes, const MetadataIndex& index);
void append(Bytes& bytes, const SummaryOffset& offset);
void append_data_end(Bytes& bytes);
/// `summary`: the whole summary from summary_start on. The checksum covers it and the first fields of the footer.
void append_footer(Bytes& summary, const Footer& footer);

}  // namespace panvo::recorder::mcap
