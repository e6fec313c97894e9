// SPDX-License-Identifier: Apache-2.0
#include "unpacked_file.hpp"

#include <stdlib.h>
#include <zstd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <vector>

#include "free_zstd.hpp"
#include "panvo/recorder/bag_error.hpp"

namespace panvo::recorder {
namespace {

namespace fs = std::filesystem;

/// "bag_0.db3" for "bag_0.db3.zstd".
fs::path name_within(const fs::path& packed) {
  const auto stem = packed.stem();
  return stem.has_extension() ? stem : packed.filename();
}

}  // namespace

UnpackedFile::UnpackedFile(const fs::path& packed) {
  auto pattern = (fs::temp_directory_path() / "panvo_bag_XXXXXX").string();
  if (!::mkdtemp(pattern.data())) {
    throw BagError(packed.string() + ": cannot be decompressed to " + fs::temp_directory_path().string() + " (" +
                   std::strerror(errno) + "); set TMPDIR to a writable folder");
  }
  folder_ = pattern;
  path_ = folder_ / name_within(packed);
  try {
    unpack(packed);
  } catch (...) {
    std::error_code error;
    fs::remove_all(folder_, error);
    throw;
  }
}

UnpackedFile::~UnpackedFile() {
  std::error_code error;
  fs::remove_all(folder_, error);
}

void UnpackedFile::unpack(const fs::path& packed) {
  std::ifstream from(packed, std::ios::binary);
  std::ofstream to(path_, std::ios::binary);
  const std::unique_ptr<ZSTD_DCtx, FreeZstd> context(ZSTD_createDCtx());
  std::vector<char> in(ZSTD_DStreamInSize());
  std::vector<char> out(ZSTD_DStreamOutSize());
  while (from.read(in.data(), static_cast<std::streamsize>(in.size())), from.gcount() > 0) {
    ZSTD_inBuffer input{in.data(), static_cast<std::size_t>(from.gcount()), 0};
    while (input.pos < input.size) {
      ZSTD_outBuffer output{out.data(), out.size(), 0};
      const auto result = ZSTD_decompressStream(context.get(), &output, &input);
      to.write(out.data(), static_cast<std::streamsize>(output.pos));
      if (!to) {
        throw BagError(packed.string() + ": not enough space to decompress it in " + folder_.parent_path().string() +
                       "; set TMPDIR to a folder on a larger disk");
      }
      if (ZSTD_isError(result) != 0) {
        return;  // the reader of the copy detects the missing rest
      }
    }
  }
  to.flush();
}

}  // namespace panvo::recorder
