// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "builtin_interfaces/msg/Time.h"
#include "panvo/interfaces/cdr.hpp"
#include "panvo/interfaces/message_layout.hpp"
#include "panvo/interfaces/message_type.hpp"

/// Builds a MessageType from a message class. Only for generated message tables.
namespace panvo::interfaces {

/// Generated for each message class: name, dds_name, hash, definition, layout and stamp_ns().
template <class Message>
struct Facts;

inline constexpr std::size_t kEncapsulationSize = 4;

/// Data and functions of a message class that encoding and decoding need.
struct CdrType {
  std::string_view name;
  const CdrLayout* layout;
  void (*write)(const void* message, CdrWriter& writer);
  void (*read)(void* message, CdrReader& reader);
};

/// Writes encapsulation header and message as XCDR1, little endian. Writes every byte of `out`, which must have the
/// serialised size.
void encode(const CdrType& type, const void* message, std::span<std::uint8_t> out);

/// Byte order according to the encapsulation header. Throws DecodeError if the encapsulation is not plain CDR.
std::endian check_encapsulation(std::string_view type_name, std::span<const std::uint8_t> bytes);

/// Decodes `bytes`, which start with the encapsulation header. Throws DecodeError if they are not a message of this
/// type.
void decode(const CdrType& type, std::span<const std::uint8_t> bytes, void* message);

std::optional<std::int64_t> to_ns(const builtin_interfaces::msg::Time& time);

template <class Message>
constexpr CdrType kCdrType{
    .name = Facts<Message>::name,
    .layout = &Facts<Message>::layout,
    .write = [](const void* message, CdrWriter& writer) { writer(*static_cast<const Message*>(message)); },
    .read = [](void* message, CdrReader& reader) { reader(*static_cast<Message*>(message)); },
};

template <class Message>
std::size_t serialized_size(const void* message) {
  CdrSize size;
  size(*static_cast<const Message*>(message));
  return kEncapsulationSize + size.value();
}

template <class Message>
void serialize(const void* message, std::span<std::uint8_t> out) {
  encode(kCdrType<Message>, message, out);
}

template <class Message>
std::shared_ptr<void> deserialize(std::span<const std::uint8_t> bytes) {
  auto message = std::make_shared<Message>();
  decode(kCdrType<Message>, bytes, message.get());
  return message;
}

/// Returns nullptr for a type without rules.
template <class Message>
constexpr auto problem_function() -> std::optional<std::string> (*)(const void*) {
  if constexpr (requires(const Message& message) { problem_of(message); }) {
    return [](const void* message) { return problem_of(*static_cast<const Message*>(message)); };
  } else {
    return nullptr;
  }
}

template <class Message>
constexpr MessageType kMessageType{
    .name = Facts<Message>::name,
    .dds_name = Facts<Message>::dds_name,
    .hash = Facts<Message>::hash,
    .definition = Facts<Message>::definition,
    .layout = &Facts<Message>::layout,
    .cpp_type = &typeid(Message),
    .serialized_size = serialized_size<Message>,
    .serialize = serialize<Message>,
    .deserialize = deserialize<Message>,
    .stamp_ns = [](const void* message) { return Facts<Message>::stamp_ns(*static_cast<const Message*>(message)); },
    .is_stamped_when_sent = kIsStampedWhenSent<Message>,
    .problem = problem_function<Message>(),
};

template <class Message>
const MessageType& message_type() {
  return kMessageType<Message>;
}

/// Registers the types of one message library with find_message_type() when the library is loaded. The library must
/// never be unloaded.
class MessageTable {
 public:
  explicit MessageTable(std::span<const MessageType* const> types)
      : MessageTable(types, sizeof(MessageType), sizeof(CdrField)) {}

 private:
  friend class MessageTableTest;
  /// Different sizes reveal a library that was compiled with different headers; its types are not registered.
  MessageTable(std::span<const MessageType* const> types, std::size_t type_size, std::size_t field_size);
};

}  // namespace panvo::interfaces
