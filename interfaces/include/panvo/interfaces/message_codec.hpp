// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "builtin_interfaces/msg/Time.h"
#include "panvo/interfaces/message_layout.hpp"
#include "panvo/interfaces/message_type.hpp"

namespace eprosima::fastcdr {
class Cdr;
}  // namespace eprosima::fastcdr

/// For generated tables of messages only: what makes a MessageType of a message's class.
namespace panvo::interfaces {

/// What the generated table says of a message class: name, dds_name, hash, definition, layout and stamp_ns().
template <class Message>
struct Facts;

inline constexpr std::size_t kEncapsulationSize = 4;

/// What encoding and decoding need to know of a message class.
struct CdrType {
  std::string_view name;
  const CdrLayout* layout;
  void (*write)(const void* message, eprosima::fastcdr::Cdr& cdr);
  void (*read)(void* message, eprosima::fastcdr::Cdr& cdr);
};

/// Encapsulation header and message, XCDR1 little endian. Every byte of `out` is written.
void encode(const CdrType& type, const void* message, std::span<std::uint8_t> out);

/// The byte order that the encapsulation header tells; throws DecodeError for one that is not plain CDR's.
std::endian check_encapsulation(std::string_view type_name, std::span<const std::uint8_t> bytes);

/// Throws DecodeError for bytes that are not a message of that type.
void decode(const CdrType& type, std::span<const std::uint8_t> bytes, void* message);

std::optional<std::int64_t> to_ns(const builtin_interfaces::msg::Time& time);

template <class Message>
constexpr CdrType kCdrType{
    .name = Facts<Message>::name,
    .layout = &Facts<Message>::layout,
    .write = [](const void* message,
                eprosima::fastcdr::Cdr& cdr) { static_cast<const Message*>(message)->serialize(cdr); },
    .read = [](void* message, eprosima::fastcdr::Cdr& cdr) { static_cast<Message*>(message)->deserialize(cdr); },
};

template <class Message>
std::size_t serialized_size(const void* message) {
  return kEncapsulationSize + Message::getCdrSerializedSize(*static_cast<const Message*>(message));
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

/// nullptr for a type without rules.
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

/// The types of one library of messages: find_message_type() knows them from when the library is loaded. It must never be unloaded.
class MessageTable {
 public:
  explicit MessageTable(std::span<const MessageType* const> types)
      : MessageTable(types, sizeof(MessageType), sizeof(CdrField)) {}

 private:
  friend class MessageTableTest;
  /// The sizes tell a library that was compiled with other headers from one that fits.
  MessageTable(std::span<const MessageType* const> types, std::size_t type_size, std::size_t field_size);
};

}  // namespace panvo::interfaces
