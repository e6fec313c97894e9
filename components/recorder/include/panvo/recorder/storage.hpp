// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace panvo::recorder {

/// File format of a bag.
enum class Storage {
  kSqlite3,  ///< .db3: ROS 2's default up to Humble
  kMcap      ///< .mcap: ROS 2's default since Iron
};

/// Compression of the chunks of an MCAP file; a .db3 is not compressed.
enum class Compression { kNone, kLz4, kZstd };

/// Names: "sqlite3", "mcap"; "none", "lz4", "zstd".
std::string to_text(Storage storage);
std::string to_text(Compression compression);

/// Parse the names above. Throw BagError with a list of valid names.
Storage storage_from_text(const std::string& text);
Compression compression_from_text(const std::string& text);

}  // namespace panvo::recorder
