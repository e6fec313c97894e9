// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "panvo/recorder/storage.hpp"
#include "record.hpp"

namespace panvo::recorder::mcap {

/// Compression field of a chunk: "", "lz4" (frame format) or "zstd". compression_of() returns nullopt for other names.
std::optional<Compression> compression_of(std::string_view name);
std::string_view name_of(Compression compression);

/// Throws StorageError if the compressor fails, e.g. for lack of memory.
Bytes compress(Compression compression, ByteSpan bytes);

struct Decompressed {
  Bytes bytes;        ///< the data before the fault
  std::string fault;  ///< empty: complete
};

/// Decompresses as much as possible of complete or truncated data, at most `expected` bytes. Memory grows with the
/// actual output, not with `expected`.
Decompressed decompress(Compression compression, ByteSpan bytes, std::uint64_t expected);

}  // namespace panvo::recorder::mcap
