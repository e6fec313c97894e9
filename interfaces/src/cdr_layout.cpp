// SPDX-License-Identifier: Apache-2.0
#include "cdr_layout.hpp"

#include <cstring>
#include <string>

#include "panvo/interfaces/message_codec.hpp"
#include "panvo/interfaces/message_payload.hpp"

namespace panvo::interfaces {
namespace {

/// Walks over the bytes of a message member by member.
class Walk {
 public:
  Walk(std::string_view type_name, std::span<const std::uint8_t> payload, std::endian order)
      : type_name_(type_name), payload_(payload), order_(order) {}

  void message(const CdrLayout& layout) {
    for (const CdrField& field : layout.fields) {
      member(field);
    }
  }

 private:
  void member(const CdrField& field) {
    const std::uint32_t count = field.is_sequence ? length(field) : field.array_size;
    if (field.size > 0) {
      if (count > 0) {  // an empty sequence has no alignment padding after its length
        align(field, field.size);
        skip(field, std::uint64_t{count} * field.size);
      }
      return;
    }
    // Every element takes at least one byte, so a length that is too large fails at the end of the data.
    for (std::uint32_t i = 0; i < count; ++i) {
      if (field.is_string) {
        skip(field, length(field));
      } else {
        message(*field.nested);
      }
    }
  }

  std::uint32_t length(const CdrField& field) {
    align(field, sizeof(std::uint32_t));
    const std::size_t at = position_;
    skip(field, sizeof(std::uint32_t));
    std::uint32_t value = 0;
    std::memcpy(&value, payload_.data() + at, sizeof value);
    return order_ == std::endian::native ? value : __builtin_bswap32(value);
  }

  void align(const CdrField& field, std::size_t size) { skip(field, (size - position_ % size) % size); }

  void skip(const CdrField& field, std::uint64_t bytes) {
    if (bytes > payload_.size() - position_) {
      throw DecodeError(std::string(type_name_) + ": truncated or not of this type: member " + std::string(field.name) +
                        " needs " + std::to_string(bytes) + " bytes at offset " + std::to_string(position_) + " of " +
                        std::to_string(payload_.size()));
    }
    position_ += bytes;
  }

  std::string_view type_name_;
  std::span<const std::uint8_t> payload_;
  std::endian order_;
  std::size_t position_ = 0;
};

}  // namespace

void check_cdr(std::string_view type_name, const CdrLayout& layout, std::span<const std::uint8_t> payload,
               std::endian order) {
  Walk(type_name, payload, order).message(layout);
}

Payload checked_payload(const MessageType& type, std::span<const std::uint8_t> bytes) {
  const auto order = check_encapsulation(type.name, bytes);
  const Payload payload{bytes.subspan(kEncapsulationSize), order};
  check_cdr(type.name, *type.layout, payload.bytes, order);
  return payload;
}

}  // namespace panvo::interfaces
