// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: the first two bytes select the message type, the others are a received message. Decoding must throw
// DecodeError or return a message that can be sent again.
#include <cstdint>
#include <cstdlib>
#include <span>

#include "panvo/interfaces/message_text.hpp"
#include "panvo/interfaces/message_type.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace panvo::interfaces;
  if (size < 2) return 0;
  const auto types = message_types();
  const MessageType& type = *types[(data[0] | std::size_t{data[1]} << 8) % types.size()];
  const std::span<const std::uint8_t> bytes(data + 2, size - 2);
  std::shared_ptr<void> message;
  try {
    message = type.deserialize(bytes);
  } catch (const DecodeError&) {
    return 0;
  }
  type.stamp_ns(message.get());
  if (type.problem) type.problem(message.get());
  // The first encoding cuts strings at a NUL; after that, decoding and encoding must not change anything.
  const auto sent = [&type](const std::shared_ptr<void>& read) {
    Bytes out(type.serialized_size(read.get()));
    type.serialize(read.get(), out);
    return out;
  };
  const Bytes first = sent(type.deserialize(sent(message)));
  if (sent(type.deserialize(first)) != first) std::abort();
  if (to_yaml(type, bytes, 16).empty()) std::abort();
  return 0;
}
