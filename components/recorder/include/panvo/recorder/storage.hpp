// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace panvo::recorder {

/// How the files of a bag are made.
enum class Storage {
  kSqlite3,  ///< .db3: ROS 2's default up to Humble
  kMcap      ///< .mcap: ROS 2's default since Iron
};

/// How the chunks of an MCAP file are compressed; a .db3 is not.
enum class Compression { kNone, kLz4, kZstd };

/// Names as metadata.yaml and MCAP have them: "sqlite3", "mcap"; "none", "lz4", "zstd".
std::string to_text(Storage storage);
std::string to_text(Compression compression);

/// The other way; throws BagError that lists what there is.
Storage storage_from_text(const std::string& text);
Compression compression_from_text(const std::string& text);

}  // namespace panvo::recorder
