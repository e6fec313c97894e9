// SPDX-License-Identifier: Apache-2.0
#include "crc32.hpp"
#include "record.hpp"

namespace panvo::recorder::mcap {
namespace {

template <class Content>
void append_record(Bytes& bytes, Opcode opcode, Content content) {
  ByteWriter writer(bytes);
  writer.number(static_cast<std::uint8_t>(opcode));
  writer.counted<std::uint64_t>([&] { content(writer); });
}

void write_texts(ByteWriter& writer, const std::map<std::string, std::string>& texts) {
  writer.counted<std::uint32_t>([&] {
    for (const auto& [key, value] : texts) {
      writer.text(key);
      writer.text(value);
    }
  });
}

void write_by_channel(ByteWriter& writer, const std::map<std::uint16_t, std::uint64_t>& numbers) {
  writer.counted<std::uint32_t>([&] {
    for (const auto& [channel, number] : numbers) {
      writer.number(channel);
      writer.number(number);
    }
  });
}

}  // namespace

void append(Bytes& bytes, const Header& header) {
  append_record(bytes, Opcode::kHeader, [&](ByteWriter& writer) {
    writer.text(header.profile);
    writer.text(header.library);
  });
}

void append(Bytes& bytes, const Schema& schema) {
  append_record(bytes, Opcode::kSchema, [&](ByteWriter& writer) {
    writer.number(schema.id);
    writer.text(schema.name);
    writer.text(schema.encoding);
    writer.text(schema.data);
  });
}

void append(Bytes& bytes, const Channel& channel) {
  append_record(bytes, Opcode::kChannel, [&](ByteWriter& writer) {
    writer.number(channel.id);
    writer.number(channel.schema_id);
    writer.text(channel.topic);
    writer.text(channel.message_encoding);
    write_texts(writer, channel.metadata);
  });
}

void append(Bytes& bytes, const MessageHead& head, ByteSpan data) {
  append_record(bytes, Opcode::kMessage, [&](ByteWriter& writer) {
    writer.number(head.channel);
    writer.number(head.sequence);
    writer.number(head.log_time);
    writer.number(head.publish_time);
    writer.append(data);
  });
}

void append(Bytes& bytes, const ChunkHead& head) {
  ByteWriter writer(bytes);
  writer.number(static_cast<std::uint8_t>(Opcode::kChunk));
  writer.number(std::uint64_t{head.bytes() + head.records_size});
  writer.number(head.start_time);
  writer.number(head.end_time);
  writer.number(head.uncompressed_size);
  writer.number(head.crc);
  writer.text(head.compression);
  writer.number(head.records_size);
}

void append(Bytes& bytes, const MessageIndex& index) {
  append_record(bytes, Opcode::kMessageIndex, [&](ByteWriter& writer) {
    writer.number(index.channel);
    writer.counted<std::uint32_t>([&] {
      for (const auto& [time, offset] : index.entries) {
        writer.number(time);
        writer.number(offset);
      }
    });
  });
}

void append(Bytes& bytes, const ChunkIndex& index) {
  append_record(bytes, Opcode::kChunkIndex, [&](ByteWriter& writer) {
    writer.number(index.start_time);
    writer.number(index.end_time);
    writer.number(index.offset);
    writer.number(index.length);
    write_by_channel(writer, index.message_index_offsets);
    writer.number(index.message_index_length);
    writer.text(index.compression);
    writer.number(index.compressed_size);
    writer.number(index.uncompressed_size);
  });
}

void append(Bytes& bytes, const Statistics& statistics) {
  append_record(bytes, Opcode::kStatistics, [&](ByteWriter& writer) {
    writer.number(statistics.message_count);
    writer.number(statistics.schema_count);
    writer.number(statistics.channel_count);
    writer.number(statistics.attachment_count);
    writer.number(statistics.metadata_count);
    writer.number(statistics.chunk_count);
    writer.number(statistics.start_time);
    writer.number(statistics.end_time);
    write_by_channel(writer, statistics.messages_by_channel);
  });
}

void append(Bytes& bytes, const Metadata& metadata) {
  append_record(bytes, Opcode::kMetadata, [&](ByteWriter& writer) {
    writer.text(metadata.name);
    write_texts(writer, metadata.values);
  });
}

void append(Bytes& bytes, const MetadataIndex& index) {
  append_record(bytes, Opcode::kMetadataIndex, [&](ByteWriter& writer) {
    writer.number(index.offset);
    writer.number(index.length);
    writer.text(index.name);
  });
}

void append(Bytes& bytes, const SummaryOffset& offset) {
  append_record(bytes, Opcode::kSummaryOffset, [&](ByteWriter& writer) {
    writer.number(static_cast<std::uint8_t>(offset.group));
    writer.number(offset.start);
    writer.number(offset.length);
  });
}

void append_data_end(Bytes& bytes) {
  append_record(bytes, Opcode::kDataEnd, [](ByteWriter& writer) { writer.number(std::uint32_t{0}); });
}

void append_footer(Bytes& summary, const Footer& footer) {
  ByteWriter writer(summary);
  writer.number(static_cast<std::uint8_t>(Opcode::kFooter));
  writer.number(std::uint64_t{Footer::kBytes});
  writer.number(footer.summary_start);
  writer.number(footer.summary_offset_start);
  writer.number(crc32(summary));
}

}  // namespace panvo::recorder::mcap
