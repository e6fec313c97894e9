// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numeric>

#include "crc32.hpp"
#include "layout.hpp"

namespace panvo::recorder::mcap {
namespace {

constexpr std::uint64_t kFooterAndMagic = RecordHead::kBytes + Footer::kBytes + kMagic.size();
constexpr std::uint64_t kMaxSummaryBytes = std::uint64_t{1} << 30;

/// The summary lacks data that the format allows to omit.
class SparseSummary : public FormatError {
 public:
  using FormatError::FormatError;
};

struct Summary {
  std::uint64_t start = 0;
  std::vector<ChunkIndex> chunks;
  std::optional<Statistics> statistics;
};

Footer read_footer(const InputFile& file) {
  if (file.size() < kMagic.size() + kFooterAndMagic) {
    throw FormatError("it is cut off");
  }
  const auto bytes = file.read(file.size() - kFooterAndMagic, kFooterAndMagic);
  const auto head = parse_record_head(bytes);
  if (head.opcode != Opcode::kFooter || head.length != Footer::kBytes ||
      !std::equal(kMagic.begin(), kMagic.end(), bytes.end() - kMagic.size())) {
    throw FormatError("its end is missing (was the recorder killed, or the file cut off?)");
  }
  return parse_footer(ByteSpan(bytes).subspan(RecordHead::kBytes));
}

Bytes read_summary_bytes(const InputFile& file, const Footer& footer) {
  const auto end = file.size() - kFooterAndMagic;
  if (footer.summary_start == 0) {
    throw SparseSummary("it has no summary");
  }
  if (footer.summary_start < kMagic.size() || footer.summary_start > end ||
      end - footer.summary_start > kMaxSummaryBytes) {
    throw FormatError("its footer states an invalid position of the summary, byte " +
                      std::to_string(footer.summary_start));
  }
  // Includes the first fields of the footer, which the checksum covers.
  auto bytes = file.read(footer.summary_start, end - footer.summary_start + RecordHead::kBytes + 16);
  if (footer.summary_crc != 0 && crc32(bytes) != footer.summary_crc) {
    throw FormatError("its summary has a wrong checksum");
  }
  bytes.resize(static_cast<std::size_t>(end - footer.summary_start));
  return bytes;
}

Summary parse_summary(ByteSpan bytes, Layout& layout) {
  Summary summary;
  while (!bytes.empty()) {
    const auto head = parse_record_head(bytes);
    const auto content = ByteReader(bytes.subspan(RecordHead::kBytes)).take(head.length);
    switch (head.opcode) {
      case Opcode::kSchema: {
        auto schema = parse_schema(content);
        layout.schemas.try_emplace(schema.id, std::move(schema));
        break;
      }
      case Opcode::kChannel: {
        auto channel = parse_channel(content);
        layout.channels.try_emplace(channel.id, std::move(channel));
        break;
      }
      case Opcode::kChunkIndex:
        summary.chunks.push_back(parse_chunk_index(content));
        break;
      case Opcode::kStatistics:
        summary.statistics = parse_statistics(content);
        break;
      default:
        break;
    }
    bytes = bytes.subspan(RecordHead::kBytes + content.size());
  }
  return summary;
}

std::int64_t time_of(std::uint64_t time) {
  if (time >= static_cast<std::uint64_t>(INT64_MAX)) {
    throw FormatError("its summary contains invalid times");
  }
  return static_cast<std::int64_t>(time);
}

/// Throws FormatError unless the summary covers every channel and message; otherwise some would be skipped.
void take_statistics(const Summary& summary, Layout& layout) {
  if (!summary.statistics) {
    throw SparseSummary("its summary does not count the messages");
  }
  const auto& statistics = *summary.statistics;
  layout.messages = statistics.messages_by_channel;
  const bool channels_known = layout.channels.size() >= statistics.channel_count &&
                              std::all_of(layout.messages.begin(), layout.messages.end(),
                                          [&](const auto& channel) { return layout.channels.contains(channel.first); });
  if (!channels_known || layout.message_count() != statistics.message_count) {
    throw FormatError("its summary does not list every channel");
  }
  if (statistics.message_count > 0) {
    layout.first_ns = time_of(statistics.start_time);
    layout.last_ns = time_of(statistics.end_time);
  }
}

Block block_of(const ChunkIndex& chunk) {
  Block block{.is_chunk = true,
              .begin = chunk.offset,
              .end = chunk.offset + chunk.length,
              .first_ns = time_of(chunk.start_time),
              .last_ns = time_of(chunk.end_time)};
  for (const auto& [channel, offset] : chunk.message_index_offsets) {
    block.channels.emplace(channel, 0);
  }
  return block;
}

/// Reads a record between chunks (message, metadata, channel) and advances `at` past it.
void take_record_between(const InputFile& file, std::uint64_t& at, std::uint64_t end, Layout& layout) {
  const auto head = parse_record_head(file.read(at, RecordHead::kBytes));
  const auto content_begin = at + RecordHead::kBytes;
  if (!head.is_known() || head.opcode == Opcode::kChunk || content_begin > end || head.length > end - content_begin) {
    throw FormatError("its summary disagrees with the data at byte " + std::to_string(at));
  }
  if (head.opcode == Opcode::kMessage) {
    StoredMessage message;
    const auto message_head = parse_message_head(file.read(content_begin, MessageHead::kBytes));
    if (head.length < MessageHead::kBytes ||
        !describe(message_head, content_begin + MessageHead::kBytes, head.length - MessageHead::kBytes, message)) {
      throw FormatError("it has an invalid message at byte " + std::to_string(at));
    }
    add_lone_message(layout, message, at, content_begin + head.length);
  } else if (head.opcode == Opcode::kMetadata && head.length <= kMaxRecordBytes) {
    take_metadata(layout, file.read(content_begin, head.length));
  }
  at = content_begin + head.length;
}

void take_blocks(const InputFile& file, Summary& summary, Layout& layout) {
  std::sort(summary.chunks.begin(), summary.chunks.end(),
            [](const auto& a, const auto& b) { return a.offset < b.offset; });
  std::uint64_t at = kMagic.size();
  auto chunk = summary.chunks.begin();
  while (at < summary.start) {
    if (chunk == summary.chunks.end() || at < chunk->offset) {
      take_record_between(file, at, chunk == summary.chunks.end() ? summary.start : chunk->offset, layout);
      continue;
    }
    const auto room = summary.start - at;
    if (at != chunk->offset || chunk->length > room || chunk->message_index_length > room - chunk->length ||
        chunk->length == 0) {
      throw FormatError("its summary disagrees with the data at byte " + std::to_string(at));
    }
    layout.blocks.push_back(block_of(*chunk));
    at += chunk->length + chunk->message_index_length;
    ++chunk;
  }
  const bool has_chunks = !summary.chunks.empty();
  const auto lone = std::accumulate(layout.blocks.begin(), layout.blocks.end(), std::uint64_t{0},
                                    [](std::uint64_t sum, const Block& block) { return sum + block.message_count(); });
  if (!has_chunks && lone != layout.message_count()) {
    throw FormatError("its summary states a wrong number of messages");
  }
  if (chunk != summary.chunks.end()) {
    throw FormatError("its summary lists an invalid chunk at byte " + std::to_string(chunk->offset));
  }
}

}  // namespace

std::optional<Layout> read_summary(const InputFile& file, std::string& reason) {
  try {
    Layout layout;
    const auto footer = read_footer(file);
    auto summary = parse_summary(read_summary_bytes(file, footer), layout);
    summary.start = footer.summary_start;
    take_statistics(summary, layout);
    take_blocks(file, summary, layout);
    return layout;
  } catch (const SparseSummary&) {
    reason.clear();
  } catch (const FormatError& error) {
    reason = error.what();
  }
  return std::nullopt;
}

}  // namespace panvo::recorder::mcap
