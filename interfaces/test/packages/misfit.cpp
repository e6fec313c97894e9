// SPDX-License-Identifier: Apache-2.0
// A library of messages that was compiled with a larger MessageType, as one of another version would be.
#include <array>

#include "panvo/interfaces/message_codec.hpp"

namespace panvo::interfaces {

class MessageTableTest {
 public:
  static MessageTable misfit() {
    return {std::span<const MessageType* const>(), sizeof(MessageType) + 8, sizeof(CdrField)};
  }
};

namespace {
const MessageTable kTable = MessageTableTest::misfit();
}  // namespace
}  // namespace panvo::interfaces
