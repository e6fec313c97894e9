// SPDX-License-Identifier: Apache-2.0
#include "chunk.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "compression.hpp"
#include "crc32.hpp"

namespace panvo::recorder::mcap {
namespace {

// INT64_MAX is the start time of bags without messages.
constexpr auto kNoTime = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
constexpr std::uint64_t kMaxIndexBytes = 256u << 20;  // of all message indexes after one chunk

/// Parses the record at `at` and advances `at` past it. Returns false if there is no complete record.
bool take_record(Chunk& chunk, std::size_t& at) {
  const auto rest = ByteSpan(chunk.bytes).subspan(at);
  if (rest.size() < RecordHead::kBytes) {
    return false;
  }
  const auto record = parse_record_head(rest);
  if (!record.is_known() || record.length > rest.size() - RecordHead::kBytes) {
    return false;
  }
  const auto content = rest.subspan(RecordHead::kBytes, static_cast<std::size_t>(record.length));
  if (record.opcode == Opcode::kMessage) {
    StoredMessage message;
    if (!describe(parse_message_head(content), at + RecordHead::kBytes + MessageHead::kBytes,
                  content.size() - MessageHead::kBytes, message)) {
      return false;
    }
    chunk.messages.push_back(message);
  } else if (record.opcode == Opcode::kSchema) {
    chunk.schemas.push_back(parse_schema(content));
  } else if (record.opcode == Opcode::kChannel) {
    chunk.channels.push_back(parse_channel(content));
  }
  at += RecordHead::kBytes + static_cast<std::size_t>(record.length);
  return true;
}

/// Parses all records of a chunk. Returns whether all are complete.
bool take_records(Chunk& chunk) {
  std::size_t at = 0;
  try {
    while (at < chunk.bytes.size() && take_record(chunk, at)) {
    }
  } catch (const FormatError&) {
  }
  return at == chunk.bytes.size();
}

std::vector<MessageIndex> read_message_indexes(const InputFile& file, std::uint64_t offset) {
  std::vector<MessageIndex> indexes;
  std::uint64_t read = 0;
  try {
    while (read < kMaxIndexBytes) {
      const auto head = parse_record_head(file.read(offset, RecordHead::kBytes));
      if (head.opcode != Opcode::kMessageIndex || head.length > kMaxIndexBytes) {
        break;
      }
      indexes.push_back(parse_message_index(file.read(offset + RecordHead::kBytes, head.length)));
      offset += RecordHead::kBytes + head.length;
      read += RecordHead::kBytes + head.length;
    }
  } catch (const FormatError&) {
  }
  return indexes;
}

/// For a damaged chunk: replaces its messages by those found at the offsets of the index, also after the damage.
void keep_indexed(Chunk& chunk, const std::vector<MessageIndex>& indexes) {
  chunk.messages.clear();
  std::uint64_t indexed = 0;
  for (const auto& index : indexes) {
    indexed += index.entries.size();
    for (const auto& [time, offset] : index.entries) {
      if (offset >= chunk.bytes.size() || chunk.bytes[offset] != static_cast<std::uint8_t>(Opcode::kMessage)) {
        continue;
      }
      auto at = static_cast<std::size_t>(offset);
      const auto count = chunk.messages.size();
      try {
        take_record(chunk, at);
      } catch (const FormatError&) {
      }
      if (chunk.messages.size() > count && (chunk.messages.back().channel != index.channel ||
                                            static_cast<std::uint64_t>(chunk.messages.back().log_time) != time)) {
        chunk.messages.pop_back();
      }
    }
  }
  std::sort(chunk.messages.begin(), chunk.messages.end(),
            [](const auto& a, const auto& b) { return a.offset < b.offset; });
  const auto twice = std::unique(chunk.messages.begin(), chunk.messages.end(),
                                 [](const auto& a, const auto& b) { return a.offset == b.offset; });
  chunk.messages.erase(twice, chunk.messages.end());
  chunk.lost = indexed - std::min<std::uint64_t>(indexed, chunk.messages.size());
}

void decompress_records(Chunk& chunk, Bytes stored) {
  const auto compression = compression_of(chunk.head.compression);
  if (!compression) {
    chunk.fault = "has the unknown compression '" + chunk.head.compression + "'";
    return;
  }
  if (chunk.head.uncompressed_size > kMaxChunkBytes) {
    chunk.fault = "states an excessive size of " + std::to_string(chunk.head.uncompressed_size) + " bytes";
    return;
  }
  if (*compression == Compression::kNone && stored.size() == chunk.head.uncompressed_size) {
    chunk.bytes = std::move(stored);
  } else {
    auto decompressed = decompress(*compression, stored, chunk.head.uncompressed_size);
    chunk.bytes = std::move(decompressed.bytes);
    chunk.fault = std::move(decompressed.fault);
  }
  if (chunk.fault.empty() && chunk.head.crc != 0 && crc32(chunk.bytes) != chunk.head.crc) {
    chunk.fault = "has a wrong checksum, so its messages may be corrupted";
  }
}

}  // namespace

bool describe(const MessageHead& head, std::uint64_t offset, std::uint64_t size, StoredMessage& message) noexcept {
  if (head.log_time >= kNoTime || size > std::numeric_limits<std::uint32_t>::max()) {
    return false;
  }
  message = {static_cast<std::int64_t>(head.log_time), offset, static_cast<std::uint32_t>(size), head.channel};
  return true;
}

Chunk read_chunk(const InputFile& file, std::uint64_t offset) {
  const auto record = parse_record_head(file.read(offset, RecordHead::kBytes));
  if (record.opcode != Opcode::kChunk) {
    throw FormatError("is missing");
  }
  const auto content_offset = offset + RecordHead::kBytes;
  constexpr std::uint64_t kHeadAndName = 64;
  Chunk chunk;
  chunk.head = parse_chunk_head(file.read(content_offset, std::min(kHeadAndName, record.length)), record.length);
  auto stored = file.read(content_offset + chunk.head.bytes(), chunk.head.records_size);
  const bool is_cut = stored.size() < chunk.head.records_size;
  decompress_records(chunk, std::move(stored));
  if (is_cut) {
    chunk.fault = "is cut off";
  }
  const bool whole = take_records(chunk);
  if (!whole && chunk.fault.empty()) {
    chunk.fault = "contains an invalid record";
  }
  if (!chunk.fault.empty()) {
    const auto indexes =
        is_cut ? std::vector<MessageIndex>() : read_message_indexes(file, content_offset + record.length);
    if (!indexes.empty()) {
      keep_indexed(chunk, indexes);
    } else if (!whole) {
      chunk.lost = 1;  // at least
    }
  }
  return chunk;
}

}  // namespace panvo::recorder::mcap
