// SPDX-License-Identifier: Apache-2.0
#include "panvo/interfaces/cdr.hpp"

#include <algorithm>
#include <stdexcept>

namespace panvo::interfaces {
namespace {

std::size_t padding(std::size_t at, std::size_t alignment) { return (alignment - at % alignment) % alignment; }

}  // namespace

void CdrWriter::write(std::size_t alignment, const void* bytes, std::size_t size) {
  const std::size_t gap = padding(at_, alignment), left = out_.size() - at_;
  if (gap > left || size > left - gap) throw std::length_error("a message grew after its size was computed");
  std::memset(out_.data() + at_, 0, gap);
  std::memcpy(out_.data() + at_ + gap, bytes, size);
  at_ += gap + size;
}

void CdrWriter::length_of(std::size_t length) {
  if (length > UINT32_MAX) throw std::length_error("a message has more than 2^32 elements");
  const auto written = static_cast<std::uint32_t>(length);
  numbers(&written, 1);
}

void CdrWriter::text(const std::string& text) {
  const std::size_t length = text_length(text);
  length_of(length + 1);
  write(1, text.c_str(), length);
  write(1, "", 1);
}

void CdrWriter::finish() {
  std::ranges::fill(out_.subspan(at_), std::uint8_t{0});
  at_ = out_.size();
}

const std::uint8_t* CdrReader::take(std::size_t alignment, std::size_t size) {
  const std::size_t gap = padding(at_, alignment), left = bytes_.size() - at_;
  if (gap > left || size > left - gap) throw DecodeError("truncated");
  const std::uint8_t* taken = bytes_.data() + at_ + gap;
  at_ += gap + size;
  return taken;
}

bool CdrReader::is_true(std::uint8_t byte) {
  if (byte > 1) throw DecodeError("a boolean is neither 0 nor 1");
  return byte == 1;
}

void CdrReader::swap_bytes(void* values, std::size_t size, std::size_t count) {
  auto* bytes = static_cast<std::uint8_t*>(values);
  for (std::size_t i = 0; i < count; ++i, bytes += size) std::reverse(bytes, bytes + size);
}

void CdrReader::text(std::string& text) {
  const std::size_t length = read_length();
  const auto* characters = reinterpret_cast<const char*>(take(1, length));
  text.assign(characters, length > 0 && characters[length - 1] == '\0' ? length - 1 : length);
}

}  // namespace panvo::interfaces
