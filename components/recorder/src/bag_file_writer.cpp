// SPDX-License-Identifier: Apache-2.0
#include "bag_file_writer.hpp"

#include "mcap/mcap_file_writer.hpp"
#include "sqlite_file_writer.hpp"

namespace panvo::recorder {

std::uint64_t BagFileWriter::size_bytes() const {
  std::error_code error;
  const auto size = std::filesystem::file_size(path_, error);
  return error ? 0 : size;
}

std::unique_ptr<BagFileWriter> make_file_writer(const std::filesystem::path& file, const BagWriter::Options& options,
                                                const std::string& ros_distro) {
  if (options.storage == Storage::kMcap) {
    return std::make_unique<mcap::McapFileWriter>(
        file, mcap::McapFileWriter::Options{options.compression, options.chunk_bytes});
  }
  return std::make_unique<SqliteFileWriter>(file, ros_distro);
}

}  // namespace panvo::recorder
