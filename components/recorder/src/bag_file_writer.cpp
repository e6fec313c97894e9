// SPDX-License-Identifier: Apache-2.0
#include "bag_file_writer.hpp"

namespace panvo::recorder {

std::uint64_t BagFileWriter::size_bytes() const {
  std::error_code error;
  const auto size = std::filesystem::file_size(path_, error);
  return error ? 0 : size;
}

}  // namespace panvo::recorder
