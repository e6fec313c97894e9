// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "panvo/recorder/storage.hpp"
#include "record.hpp"

namespace panvo::recorder::mcap {

/// What a chunk says of how it is compressed: "", "lz4" (a frame of it) or "zstd".
std::optional<Compression> compression_of(std::string_view name);
std::string_view name_of(Compression compression);

/// Throws StorageError when the compressor refuses, which it does for want of memory.
Bytes compress(Compression compression, ByteSpan bytes);

struct Decompressed {
  Bytes bytes;        ///< as far as it went
  std::string fault;  ///< why it did not go on; empty: all of it
};

/// Takes apart what is compressed or was cut off, as far as it goes, and never more than `expected` bytes. Memory
/// grows with what comes out, whatever `expected` says.
Decompressed decompress(Compression compression, ByteSpan bytes, std::uint64_t expected);

}  // namespace panvo::recorder::mcap
