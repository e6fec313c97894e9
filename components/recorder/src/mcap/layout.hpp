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

inline constexpr std::uint64_t kMostRecordBytes = 64u << 20;  ///< of schemas, metadata and the like: more is damage

/// A stretch of an MCAP file with messages in it: a chunk, or records of messages that lie in the file by themselves.
struct Block {
  bool is_chunk = false;
  std::uint64_t begin = 0, end = 0;  ///< in the file; of a chunk its record
  std::int64_t first_ns = 0, last_ns = 0;
  /// Messages by channel; of a chunk that was not read yet the channels only, with 0. Empty: not known.
  std::map<std::uint16_t, std::uint64_t> channels{};

  std::uint64_t message_count() const;
};

/// What is where in an MCAP file.
struct Layout {
  std::vector<Block> blocks;  ///< in the order in which they lie in the file
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;
  std::map<std::uint16_t, std::uint64_t> messages;  ///< by channel
  std::int64_t first_ns = 0, last_ns = 0;           ///< where there are messages
  std::optional<std::string> bag_metadata;          ///< what rosbag2 wrote of its metadata.yaml
  std::vector<std::string> faults;                  ///< without the file's name
  std::uint64_t lost = 0;
  bool is_scanned = false;  ///< there is no usable summary, and every message has been looked at
  bool is_whole = true;     ///< nothing is known to be wrong with it

  std::uint64_t message_count() const;
};

/// By the summary at the end, and without reading chunks. nullopt where there is none, or not all that is needed, or
/// where it disagrees with the file; `reason` then says so, and is empty where nothing is wrong with that.
std::optional<Layout> read_summary(const InputFile& file, std::string& reason);

/// By reading through everything, leaping over what is damaged.
Layout scan(const InputFile& file);

/// The messages of a block of lone messages, in order; at most what read_lone_messages() found there.
std::vector<StoredMessage> read_lone_messages(const InputFile& file, const Block& block);

/// Adds a message's record, which begins at `begin`, to the block of lone messages at the end of the list, or begins
/// the next one. Blocks are small, so that a reader need not hold much of a file that has no chunks.
void add_lone_message(Layout& layout, const StoredMessage& message, std::uint64_t begin, std::uint64_t end);

/// Remembers what a Metadata record of rosbag2's says.
void take_metadata(Layout& layout, ByteSpan content);

}  // namespace panvo::recorder::mcap
