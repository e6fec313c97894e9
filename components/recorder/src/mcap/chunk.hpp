// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "input_file.hpp"
#include "record.hpp"

namespace panvo::recorder::mcap {

/// Largest accepted chunk; a larger stated size is treated as damage. (ROS 2 writes chunks of 0.8 MB, or of one
/// message.)
inline constexpr std::uint64_t kMaxChunkBytes = std::uint64_t{1} << 30;

/// Location of a message in a chunk or directly in the file.
struct StoredMessage {
  std::int64_t log_time = 0;
  std::uint64_t offset = 0;  ///< of its data
  std::uint32_t size = 0;    ///< of its data
  std::uint16_t channel = 0;
};

/// A chunk, decompressed and parsed as far as possible.
struct Chunk {
  ChunkHead head;
  Bytes bytes;                          ///< its records
  std::vector<StoredMessage> messages;  ///< in recording order
  std::vector<Schema> schemas;
  std::vector<Channel> channels;
  std::string fault;       ///< empty: none
  std::uint64_t lost = 0;  ///< unreadable messages, as far as known
};

/// Fills `message` from a record whose data begins at `offset`. Returns false if its time or size is out of range.
bool describe(const MessageHead& head, std::uint64_t offset, std::uint64_t size, StoredMessage& message) noexcept;

/// Reads the chunk whose record begins at `offset`. A damaged or truncated chunk keeps its readable messages; if the
/// file has a message index, those that agree with it. Throws FormatError if there is no chunk.
Chunk read_chunk(const InputFile& file, std::uint64_t offset);

}  // namespace panvo::recorder::mcap
