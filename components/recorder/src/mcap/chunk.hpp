// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "input_file.hpp"
#include "record.hpp"

namespace panvo::recorder::mcap {

/// No chunk is larger: one that says it is, is damaged. (ROS 2 writes chunks of 0.8 MB, or of one message.)
inline constexpr std::uint64_t kMostChunkBytes = std::uint64_t{1} << 30;

/// Where a message lies: in a chunk, or in the file itself.
struct StoredMessage {
  std::int64_t log_time = 0;
  std::uint64_t offset = 0;  ///< of its data
  std::uint32_t size = 0;    ///< of its data
  std::uint16_t channel = 0;
};

/// A chunk taken apart, as far as it can be.
struct Chunk {
  ChunkHead head;
  Bytes bytes;                          ///< its records
  std::vector<StoredMessage> messages;  ///< in the order in which they were recorded
  std::vector<Schema> schemas;
  std::vector<Channel> channels;
  std::string fault;       ///< what is wrong with it; empty: nothing
  std::uint64_t lost = 0;  ///< messages that were in it and cannot be read, as far as is known
};

/// The message of a record, whose data is at `offset`; false: no bag knows such a time, or no memory such a size.
bool describe(const MessageHead& head, std::uint64_t offset, std::uint64_t size, StoredMessage& message) noexcept;

/// Reads the chunk whose record begins at `offset`. One that is damaged or cut off keeps its readable messages: where
/// the file has an index of them, those that agree with it. Throws FormatError when there is no chunk.
Chunk read_chunk(const InputFile& file, std::uint64_t offset);

}  // namespace panvo::recorder::mcap
