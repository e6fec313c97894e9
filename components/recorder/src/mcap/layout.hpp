// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "chunk.hpp"
#include "input_file.hpp"
#include "record.hpp"

namespace panvo::recorder::mcap {

inline constexpr std::uint64_t kMaxRecordBytes = 64u << 20;  ///< of schemas, metadata etc.; larger ones are damaged

/// A part of an MCAP file that holds messages: a chunk, or consecutive message records outside chunks.
struct Block {
  bool is_chunk = false;
  std::uint64_t begin = 0, end = 0;  ///< byte range in the file; for a chunk, its record
  std::int64_t first_ns = 0, last_ns = 0;
  /// Message counts by channel; 0 for each channel of a chunk not read yet. Empty: unknown.
  std::map<std::uint16_t, std::uint64_t> channels{};

  std::uint64_t message_count() const;
};

/// Structure of an MCAP file.
struct Layout {
  std::vector<Block> blocks;  ///< in file order
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;
  std::map<std::uint16_t, std::uint64_t> messages;  ///< by channel
  std::int64_t first_ns = 0, last_ns = 0;           ///< valid if there are messages
  std::optional<std::string> bag_metadata;          ///< rosbag2's copy of metadata.yaml
  std::vector<std::string> faults;                  ///< without the file's name
  std::uint64_t lost = 0;
  bool is_scanned = false;  ///< no usable summary; every message was visited
  bool is_whole = true;     ///< no known faults

  std::uint64_t message_count() const;
};

/// Reads the layout from the summary at the end, without reading chunks. Returns nullopt if the summary is missing,
/// incomplete or disagrees with the file. `reason` then describes the fault; it is empty if the format allows the
/// omission.
std::optional<Layout> read_summary(const InputFile& file, std::string& reason);

/// Determines the layout by reading the whole file; skips damaged parts.
Layout scan(const InputFile& file);

/// Reads the messages of a block that is not a chunk, in file order.
std::vector<StoredMessage> read_lone_messages(const InputFile& file, const Block& block);

/// Appends the message record at [begin, end) to the last block if that has room and is adjacent and not a chunk;
/// otherwise starts a new block. Blocks are small to limit a reader's memory for files without chunks.
void add_lone_message(Layout& layout, const StoredMessage& message, std::uint64_t begin, std::uint64_t end);

/// Stores the content of rosbag2's Metadata record in the layout; ignores other Metadata records.
void take_metadata(Layout& layout, ByteSpan content);

}  // namespace panvo::recorder::mcap
