// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::runtime {

/// Throws ConfigError if `compiled_hash` is not the hash of the type: a plugin and the library of its messages were built from different definitions.
void require_definition(const interfaces::MessageType& type, std::string_view compiled_hash);

/// message_type<Message>(), if its library holds the definition that the calling file was compiled with. Throws ConfigError otherwise.
template <class Message>
const interfaces::MessageType& compiled_type() {
  const auto& type = interfaces::message_type<Message>();
  require_definition(type, interfaces::CompiledHash<Message>::kValue);
  return type;
}

}  // namespace panvo::runtime
