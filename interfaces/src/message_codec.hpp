// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "builtin_interfaces/msg/Time.h"
#include "cdr_layout.hpp"
#include "panvo/interfaces/message_type.hpp"

namespace eprosima::fastcdr {
class Cdr;
}  // namespace eprosima::fastcdr

namespace panvo::interfaces {

/// What the generated table says of a message class: name, dds_name, hash, definition, layout and stamp_ns().
template <class Message>
struct Facts;

inline constexpr std::size_t kEncapsulationSize = 4;

/// A decoded or to be encoded message, seen as something that knows how to write and read itself.
struct CdrBody {
  const void* writes = nullptr;
  void* reads = nullptr;
  void (*write)(const void* message, eprosima::fastcdr::Cdr& cdr) = nullptr;
  void (*read)(void* message, eprosima::fastcdr::Cdr& cdr) = nullptr;
};

/// Encapsulation header and body, XCDR1 little endian. What the body leaves of `out` is filled with zeros.
void encode(const CdrBody& body, std::span<std::uint8_t> out);

/// Reads the body. Throws DecodeError for bytes that are not a message of that name and layout.
void decode(std::string_view type_name, const CdrLayout& layout, std::span<const std::uint8_t> bytes, const CdrBody& body);

std::optional<std::int64_t> to_ns(const builtin_interfaces::msg::Time& time);

template <class Message>
std::size_t serialized_size(const void* message) {
  return kEncapsulationSize + Message::getCdrSerializedSize(*static_cast<const Message*>(message));
}

template <class Message>
void serialize(const void* message, std::span<std::uint8_t> out) {
  encode({.writes = message,
          .write = [](const void* m, eprosima::fastcdr::Cdr& cdr) { static_cast<const Message*>(m)->serialize(cdr); }},
         out);
}

template <class Message>
std::shared_ptr<void> deserialize(std::span<const std::uint8_t> bytes) {
  auto message = std::make_shared<Message>();
  decode(Facts<Message>::name, Facts<Message>::layout, bytes,
         {.reads = message.get(),
          .read = [](void* m, eprosima::fastcdr::Cdr& cdr) { static_cast<Message*>(m)->deserialize(cdr); }});
  return message;
}

template <class Message>
constexpr MessageType kMessageType{
    .name = Facts<Message>::name,
    .dds_name = Facts<Message>::dds_name,
    .hash = Facts<Message>::hash,
    .definition = Facts<Message>::definition,
    .cpp_type = &typeid(Message),
    .serialized_size = serialized_size<Message>,
    .serialize = serialize<Message>,
    .deserialize = deserialize<Message>,
    .stamp_ns = [](const void* message) { return Facts<Message>::stamp_ns(*static_cast<const Message*>(message)); },
};

template <class Message>
const MessageType& message_type() {
  return kMessageType<Message>;
}

}  // namespace panvo::interfaces
