// SPDX-License-Identifier: Apache-2.0
#include "compression.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>

#include "../free_zstd.hpp"
#include "storage_error.hpp"

namespace panvo::recorder::mcap {
namespace {

constexpr int kZstdLevel = 1;  // for images, higher levels take twice the time to save two percent
constexpr std::size_t kFirstPart = 256u << 10;

/// A buffer that grows as it is filled, up to a limit.
class Output {
 public:
  explicit Output(std::uint64_t limit) : limit_(limit) {}

  /// Free space; empty if the limit is reached.
  std::span<std::uint8_t> room() {
    if (used_ == bytes_.size()) {
      bytes_.resize(std::min<std::uint64_t>(limit_, std::max(kFirstPart, bytes_.size() * 2)));
    }
    return std::span(bytes_).subspan(used_);
  }
  void filled(std::size_t count) { used_ += count; }
  Bytes take() {
    bytes_.resize(used_);
    return std::move(bytes_);
  }

 private:
  std::uint64_t limit_;
  Bytes bytes_;
  std::size_t used_ = 0;
};

struct FreeLz4 {
  void operator()(LZ4F_dctx* context) const noexcept { LZ4F_freeDecompressionContext(context); }
};

constexpr const char* kTooMuch = "contains more data than stated";
constexpr const char* kCutOff = "is cut off";

Decompressed decompress_zstd(ByteSpan bytes, std::uint64_t expected) {
  const std::unique_ptr<ZSTD_DCtx, FreeZstd> context(ZSTD_createDCtx());
  Output output(expected);
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  std::string fault;
  while (fault.empty()) {
    const auto room = output.room();
    std::uint8_t beyond = 0;  // requested when the output is full, to detect the end
    ZSTD_outBuffer out{room.empty() ? &beyond : room.data(), room.empty() ? 1 : room.size(), 0};
    const auto result = ZSTD_decompressStream(context.get(), &out, &in);
    if (!room.empty()) {
      output.filled(out.pos);
    }
    if (ZSTD_isError(result) != 0) {
      fault = ZSTD_getErrorName(result);
    } else if (room.empty() && out.pos > 0) {
      fault = kTooMuch;
    } else if (result == 0 && in.pos == in.size) {
      break;
    } else if (in.pos == in.size && out.pos < out.size) {
      fault = kCutOff;
    }
  }
  return {output.take(), std::move(fault)};
}

Decompressed decompress_lz4(ByteSpan bytes, std::uint64_t expected) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) {
    return {{}, "cannot be decompressed (out of memory)"};
  }
  const std::unique_ptr<LZ4F_dctx, FreeLz4> context(made);
  Output output(expected);
  std::string fault;
  while (fault.empty()) {
    const auto room = output.room();
    std::uint8_t beyond = 0;
    std::size_t out = room.empty() ? 1 : room.size();
    std::size_t in = bytes.size();
    const auto result =
        LZ4F_decompress(context.get(), room.empty() ? &beyond : room.data(), &out, bytes.data(), &in, nullptr);
    if (LZ4F_isError(result) != 0) {
      fault = LZ4F_getErrorName(result);
      break;
    }
    if (!room.empty()) {
      output.filled(out);
    }
    bytes = bytes.subspan(in);
    if (room.empty() && out > 0) {
      fault = kTooMuch;
    } else if (result == 0 && bytes.empty()) {
      break;
    } else if (in == 0 && out == 0) {
      fault = kCutOff;
    }
  }
  return {output.take(), std::move(fault)};
}

}  // namespace

std::optional<Compression> compression_of(std::string_view name) {
  for (const auto compression : {Compression::kNone, Compression::kLz4, Compression::kZstd}) {
    if (name == name_of(compression)) {
      return compression;
    }
  }
  return std::nullopt;
}

std::string_view name_of(Compression compression) {
  switch (compression) {
    case Compression::kLz4:
      return "lz4";
    case Compression::kZstd:
      return "zstd";
    case Compression::kNone:
      break;
  }
  return "";
}

Bytes compress(Compression compression, ByteSpan bytes) {
  Bytes compressed;
  if (compression == Compression::kZstd) {
    compressed.resize(ZSTD_compressBound(bytes.size()));
    const auto size = ZSTD_compress(compressed.data(), compressed.size(), bytes.data(), bytes.size(), kZstdLevel);
    if (ZSTD_isError(size) != 0) {
      throw StorageError(ZSTD_getErrorName(size), false);
    }
    compressed.resize(size);
  } else if (compression == Compression::kLz4) {
    compressed.resize(LZ4F_compressFrameBound(bytes.size(), nullptr));
    const auto size = LZ4F_compressFrame(compressed.data(), compressed.size(), bytes.data(), bytes.size(), nullptr);
    if (LZ4F_isError(size) != 0) {
      throw StorageError(LZ4F_getErrorName(size), false);
    }
    compressed.resize(size);
  } else {
    compressed.assign(bytes.begin(), bytes.end());
  }
  return compressed;
}

Decompressed decompress(Compression compression, ByteSpan bytes, std::uint64_t expected) {
  if (bytes.empty() && expected == 0) {
    return {};
  }
  if (compression == Compression::kNone) {
    const bool more = bytes.size() > expected;
    const auto kept = more ? bytes.first(static_cast<std::size_t>(expected)) : bytes;
    return {Bytes(kept.begin(), kept.end()), more ? kTooMuch : bytes.size() < expected ? kCutOff : ""};
  }
  auto decompressed =
      compression == Compression::kZstd ? decompress_zstd(bytes, expected) : decompress_lz4(bytes, expected);
  if (decompressed.fault.empty() && decompressed.bytes.size() < expected) {
    decompressed.fault = "contains less data than stated";
  }
  return decompressed;
}

}  // namespace panvo::recorder::mcap
