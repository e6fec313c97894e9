// SPDX-License-Identifier: Apache-2.0
#include "layout.hpp"

#include <algorithm>
#include <numeric>

namespace panvo::recorder::mcap {
namespace {

constexpr std::uint64_t kMaxLoneMessages = 4096;    // in one block
constexpr std::uint64_t kMaxLoneBytes = 16u << 20;  // of one block with several messages

std::uint64_t sum_of(const std::map<std::uint16_t, std::uint64_t>& by_channel) {
  return std::accumulate(by_channel.begin(), by_channel.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const auto& channel) { return sum + channel.second; });
}

}  // namespace

std::uint64_t Block::message_count() const { return sum_of(channels); }
std::uint64_t Layout::message_count() const { return sum_of(messages); }

std::vector<StoredMessage> read_lone_messages(const InputFile& file, const Block& block) {
  constexpr std::size_t kHeads = RecordHead::kBytes + MessageHead::kBytes;
  std::vector<StoredMessage> messages;
  try {
    for (auto at = block.begin; at < block.end;) {
      const auto bytes = file.read(at, kHeads);
      const auto record = parse_record_head(bytes);
      const auto content = ByteSpan(bytes).subspan(RecordHead::kBytes);
      StoredMessage message;
      if (record.opcode == Opcode::kMessage && record.length >= MessageHead::kBytes &&
          describe(parse_message_head(content), at + kHeads, record.length - MessageHead::kBytes, message)) {
        messages.push_back(message);
      }
      at += RecordHead::kBytes + std::min(record.length, block.end - at);
    }
  } catch (const FormatError&) {
    // The file has changed since it was opened; return the messages read so far.
  }
  return messages;
}

void add_lone_message(Layout& layout, const StoredMessage& message, std::uint64_t begin, std::uint64_t end) {
  const auto fits = [&](const Block& block) {
    return !block.is_chunk && block.end == begin && block.message_count() < kMaxLoneMessages &&
           end - block.begin <= kMaxLoneBytes;
  };
  if (layout.blocks.empty() || !fits(layout.blocks.back())) {
    layout.blocks.push_back({.begin = begin, .first_ns = message.log_time, .last_ns = message.log_time});
  }
  auto& block = layout.blocks.back();
  block.end = end;
  block.first_ns = std::min(block.first_ns, message.log_time);
  block.last_ns = std::max(block.last_ns, message.log_time);
  ++block.channels[message.channel];
}

void take_metadata(Layout& layout, ByteSpan content) {
  const auto metadata = parse_metadata_record(content);
  const auto text = metadata.values.find("serialized_metadata");
  if (metadata.name == "rosbag2" && text != metadata.values.end()) {
    layout.bag_metadata = text->second;  // the last record wins: the first was written before the messages
  }
}

}  // namespace panvo::recorder::mcap
