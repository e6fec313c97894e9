// SPDX-License-Identifier: Apache-2.0
#include "panvo/interfaces/message_codec.hpp"

#include <string>

#include "cdr_layout.hpp"

namespace panvo::interfaces {

void encode(const CdrType& type, const void* message, std::span<std::uint8_t> out) {
  constexpr std::uint8_t kLittleEndian[kEncapsulationSize] = {0, 1, 0, 0};
  CdrWriter(out).numbers(kLittleEndian, kEncapsulationSize);
  CdrWriter writer(out.subspan(kEncapsulationSize));
  type.write(message, writer);
  writer.finish();
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
  CdrReader reader(bytes.subspan(kEncapsulationSize), order);
  try {
    type.read(message, reader);
  } catch (const DecodeError& error) {
    throw DecodeError(std::string(type.name) + ": " + error.what());
  }
}

std::optional<std::int64_t> to_ns(const builtin_interfaces::msg::Time& time) {
  return std::int64_t{time.sec()} * 1'000'000'000 + time.nanosec();
}

}  // namespace panvo::interfaces
