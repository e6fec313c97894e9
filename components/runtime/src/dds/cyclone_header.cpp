// SPDX-License-Identifier: Apache-2.0
#include "cyclone_header.hpp"

#include <cstddef>

namespace panvo::runtime::dds {
namespace {

constexpr std::size_t kCdrHeaderSize = 4, kNumberSize = 8, kHeaderSize = 2 * kNumberSize;

bool is_little_endian(const interfaces::Bytes& message) { return (message[1] & 1) != 0; }

std::uint64_t number_at(const interfaces::Bytes& message, std::size_t at) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < kNumberSize; ++i) {
    const auto shift = 8 * (is_little_endian(message) ? i : kNumberSize - 1 - i);
    number |= std::uint64_t{message[at + i]} << shift;
  }
  return number;
}

void put_number(std::uint64_t number, bool is_little, interfaces::Bytes& out) {
  for (std::size_t i = 0; i < kNumberSize; ++i) {
    out.push_back(static_cast<std::uint8_t>(number >> 8 * (is_little ? i : kNumberSize - 1 - i)));
  }
}

}  // namespace

std::optional<CycloneHeader> take_header(interfaces::Bytes& message) {
  if (message.size() < kCdrHeaderSize + kHeaderSize) return std::nullopt;
  const CycloneHeader header{number_at(message, kCdrHeaderSize),
                             static_cast<std::int64_t>(number_at(message, kCdrHeaderSize + kNumberSize))};
  const auto begin = message.begin() + kCdrHeaderSize;
  message.erase(begin, begin + kHeaderSize);
  return header;
}

interfaces::Bytes with_header(const CycloneHeader& header, const interfaces::Bytes& message) {
  const bool is_little = is_little_endian(message);
  interfaces::Bytes out(message.begin(), message.begin() + kCdrHeaderSize);
  out.reserve(message.size() + kHeaderSize);
  put_number(header.client, is_little, out);
  put_number(static_cast<std::uint64_t>(header.number), is_little, out);
  out.insert(out.end(), message.begin() + kCdrHeaderSize, message.end());
  return out;
}

}  // namespace panvo::runtime::dds
