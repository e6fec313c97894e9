// SPDX-License-Identifier: Apache-2.0
#include "record.hpp"

namespace panvo::recorder::mcap {
namespace {

std::map<std::string, std::string> read_texts(ByteReader& reader) {
  std::map<std::string, std::string> texts;
  ByteReader entries(reader.counted());
  while (entries.remaining() > 0) {
    auto key = entries.text();
    texts[std::move(key)] = entries.text();
  }
  return texts;
}

std::map<std::uint16_t, std::uint64_t> read_by_channel(ByteReader& reader) {
  std::map<std::uint16_t, std::uint64_t> numbers;
  ByteReader entries(reader.counted());
  while (entries.remaining() > 0) {
    const auto channel = entries.number<std::uint16_t>();
    numbers[channel] = entries.number<std::uint64_t>();
  }
  return numbers;
}

}  // namespace

RecordHead parse_record_head(ByteSpan bytes) {
  ByteReader reader(bytes);
  RecordHead head;
  head.opcode = static_cast<Opcode>(reader.number<std::uint8_t>());
  head.length = reader.number<std::uint64_t>();
  return head;
}

Header parse_header(ByteSpan content) {
  ByteReader reader(content);
  Header header;
  header.profile = reader.text();
  header.library = reader.text();
  return header;
}

Schema parse_schema(ByteSpan content) {
  ByteReader reader(content);
  Schema schema;
  schema.id = reader.number<std::uint16_t>();
  schema.name = reader.text();
  schema.encoding = reader.text();
  schema.data = reader.text();
  return schema;
}

Channel parse_channel(ByteSpan content) {
  ByteReader reader(content);
  Channel channel;
  channel.id = reader.number<std::uint16_t>();
  channel.schema_id = reader.number<std::uint16_t>();
  channel.topic = reader.text();
  channel.message_encoding = reader.text();
  channel.metadata = read_texts(reader);
  return channel;
}

MessageHead parse_message_head(ByteSpan content) {
  ByteReader reader(content);
  MessageHead head;
  head.channel = reader.number<std::uint16_t>();
  head.sequence = reader.number<std::uint32_t>();
  head.log_time = reader.number<std::uint64_t>();
  head.publish_time = reader.number<std::uint64_t>();
  return head;
}

ChunkHead parse_chunk_head(ByteSpan beginning, std::uint64_t content_length) {
  ByteReader reader(beginning);
  ChunkHead head;
  head.start_time = reader.number<std::uint64_t>();
  head.end_time = reader.number<std::uint64_t>();
  head.uncompressed_size = reader.number<std::uint64_t>();
  head.crc = reader.number<std::uint32_t>();
  head.compression = reader.text();
  head.records_size = reader.number<std::uint64_t>();
  if (head.records_size > content_length || head.records_size + head.bytes() != content_length) {
    throw FormatError("has contradictory sizes");
  }
  return head;
}

MessageIndex parse_message_index(ByteSpan content) {
  ByteReader reader(content);
  MessageIndex index;
  index.channel = reader.number<std::uint16_t>();
  ByteReader entries(reader.counted());
  index.entries.reserve(entries.remaining() / 16);
  while (entries.remaining() > 0) {
    const auto time = entries.number<std::uint64_t>();
    index.entries.emplace_back(time, entries.number<std::uint64_t>());
  }
  return index;
}

ChunkIndex parse_chunk_index(ByteSpan content) {
  ByteReader reader(content);
  ChunkIndex index;
  index.start_time = reader.number<std::uint64_t>();
  index.end_time = reader.number<std::uint64_t>();
  index.offset = reader.number<std::uint64_t>();
  index.length = reader.number<std::uint64_t>();
  index.message_index_offsets = read_by_channel(reader);
  index.message_index_length = reader.number<std::uint64_t>();
  index.compression = reader.text();
  index.compressed_size = reader.number<std::uint64_t>();
  index.uncompressed_size = reader.number<std::uint64_t>();
  return index;
}

Statistics parse_statistics(ByteSpan content) {
  ByteReader reader(content);
  Statistics statistics;
  statistics.message_count = reader.number<std::uint64_t>();
  statistics.schema_count = reader.number<std::uint16_t>();
  statistics.channel_count = reader.number<std::uint32_t>();
  statistics.attachment_count = reader.number<std::uint32_t>();
  statistics.metadata_count = reader.number<std::uint32_t>();
  statistics.chunk_count = reader.number<std::uint32_t>();
  statistics.start_time = reader.number<std::uint64_t>();
  statistics.end_time = reader.number<std::uint64_t>();
  statistics.messages_by_channel = read_by_channel(reader);
  return statistics;
}

Metadata parse_metadata_record(ByteSpan content) {
  ByteReader reader(content);
  Metadata metadata;
  metadata.name = reader.text();
  metadata.values = read_texts(reader);
  return metadata;
}

Footer parse_footer(ByteSpan content) {
  ByteReader reader(content);
  Footer footer;
  footer.summary_start = reader.number<std::uint64_t>();
  footer.summary_offset_start = reader.number<std::uint64_t>();
  footer.summary_crc = reader.number<std::uint32_t>();
  return footer;
}

}  // namespace panvo::recorder::mcap
