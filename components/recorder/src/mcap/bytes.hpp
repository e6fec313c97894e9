// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::recorder::mcap {

static_assert(std::endian::native == std::endian::little, "MCAP is little-endian and is read without byte swapping");

/// Bytes that violate the format.
class FormatError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads numbers and strings from bytes. Throws FormatError instead of reading beyond the end.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  std::size_t remaining() const noexcept { return rest_.size(); }

  template <std::unsigned_integral Number>
  Number number() {
    Number value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::span<const std::uint8_t> take(std::uint64_t count) {
    if (count > rest_.size()) {
      throw FormatError("ends " + std::to_string(count - rest_.size()) + " bytes early");
    }
    const auto taken = rest_.first(static_cast<std::size_t>(count));
    rest_ = rest_.subspan(static_cast<std::size_t>(count));
    return taken;
  }
  /// Reads a 32-bit length and returns the bytes that follow it.
  std::span<const std::uint8_t> counted() { return take(number<std::uint32_t>()); }
  std::string text() {
    const auto bytes = counted();
    return {bytes.begin(), bytes.end()};
  }

 private:
  std::span<const std::uint8_t> rest_;
};

/// Appends numbers and strings to a vector.
class ByteWriter {
 public:
  explicit ByteWriter(interfaces::Bytes& bytes) : bytes_(bytes) {}

  template <std::unsigned_integral Number>
  void number(Number value) {
    const auto at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  void append(std::span<const std::uint8_t> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  void text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
  }
  /// Appends a length of type `Length`, then the bytes that `content` appends.
  template <std::unsigned_integral Length, class Content>
  void counted(Content content) {
    const auto at = bytes_.size();
    number(Length{0});
    content();
    const auto length = static_cast<Length>(bytes_.size() - at - sizeof(Length));
    std::memcpy(bytes_.data() + at, &length, sizeof length);
  }

 private:
  interfaces::Bytes& bytes_;
};

}  // namespace panvo::recorder::mcap
