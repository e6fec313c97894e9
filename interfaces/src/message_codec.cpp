// SPDX-License-Identifier: Apache-2.0
#include "panvo/interfaces/message_codec.hpp"

#include <algorithm>
#include <string>

#include <fastcdr/Cdr.h>
#include <fastcdr/exceptions/Exception.h>

#include "cdr_layout.hpp"

namespace panvo::interfaces {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

void encode(const CdrType& type, const void* message, std::span<std::uint8_t> out) {
  FastBuffer buffer(reinterpret_cast<char*>(out.data()), out.size());
  Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  type.write(message, cdr);
  // Fast CDR sends a string up to its first NUL, so it may write less than the computed size.
  std::fill(out.begin() + static_cast<std::ptrdiff_t>(cdr.getSerializedDataLength()), out.end(), std::uint8_t{0});
  clear_padding(type.name, *type.layout, out.subspan(kEncapsulationSize));
}

std::endian check_encapsulation(std::string_view type_name, std::span<const std::uint8_t> bytes) {
  const std::string name(type_name);
  if (bytes.size() < kEncapsulationSize) {
    throw DecodeError(name + ": " + std::to_string(bytes.size()) + " bytes are too few for a message");
  }
  // 00 00: plain CDR, big endian; 00 01: little endian. Other values are parameter lists or newer encodings.
  if (bytes[0] != 0 || bytes[1] > 1) {
    throw DecodeError(name + ": encapsulation " + std::to_string(bytes[0]) + " " + std::to_string(bytes[1]) +
                      " is not plain CDR");
  }
  return bytes[1] == 1 ? std::endian::little : std::endian::big;
}

void decode(const CdrType& type, std::span<const std::uint8_t> bytes, void* message) {
  const auto order = check_encapsulation(type.name, bytes);
  check_cdr(type.name, *type.layout, bytes.subspan(kEncapsulationSize), order);
  // Fast CDR takes a pointer to non-const for reading too.
  FastBuffer buffer(const_cast<char*>(reinterpret_cast<const char*>(bytes.data())), bytes.size());
  Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
  try {
    cdr.read_encapsulation();
    type.read(message, cdr);
  } catch (const eprosima::fastcdr::exception::Exception& error) {
    throw DecodeError(std::string(type.name) + ": " + error.what());
  }
}

std::optional<std::int64_t> to_ns(const builtin_interfaces::msg::Time& time) {
  return std::int64_t{time.sec()} * 1'000'000'000 + time.nanosec();
}

}  // namespace panvo::interfaces
