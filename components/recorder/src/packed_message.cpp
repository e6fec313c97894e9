// SPDX-License-Identifier: Apache-2.0
#include "packed_message.hpp"

#include <zstd.h>

#include <algorithm>
#include <array>

#include "mcap/chunk.hpp"
#include "mcap/compression.hpp"

namespace panvo::recorder {

bool unpack_message(interfaces::Bytes& data) {
  constexpr std::array<std::uint8_t, 4> kZstd{0x28, 0xb5, 0x2f, 0xfd};
  if (data.size() < kZstd.size() || !std::equal(kZstd.begin(), kZstd.end(), data.begin())) {
    return true;
  }
  const auto size = ZSTD_getFrameContentSize(data.data(), data.size());
  if (size == ZSTD_CONTENTSIZE_UNKNOWN || size == ZSTD_CONTENTSIZE_ERROR || size > mcap::kMaxChunkBytes) {
    return false;
  }
  auto unpacked = mcap::decompress(Compression::kZstd, data, size);
  data = std::move(unpacked.bytes);
  return unpacked.fault.empty();
}

}  // namespace panvo::recorder
