// SPDX-License-Identifier: Apache-2.0
// A message library that was compiled with a larger MessageType, like one of another version.
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
