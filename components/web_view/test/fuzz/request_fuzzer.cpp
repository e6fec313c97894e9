// SPDX-License-Identifier: Apache-2.0
// What a client sends: frames, of which messages are joined, which are read as requests. Nothing but a ProtocolError may
// come of it. Input: frames of two bytes (first byte of the frame, length) and content.
#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>

#include "access.hpp"
#include "client_request.hpp"
#include "frame_assembly.hpp"
#include "protocol_error.hpp"

namespace {

using namespace panvo::web_view;

void read(std::span<const std::uint8_t> bytes, bool is_text) {
  try {
    if (is_text) {
      parse_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    } else {
      parse_binary(bytes);
    }
  } catch (const ProtocolError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::span<const std::uint8_t> rest(data, size);
  read(rest, true);
  read(rest, false);
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  is_trusted_origin(text, {});
  bearer_token(text);
  FrameAssembly assembly(1000);
  while (rest.size() >= 2) {
    const std::uint8_t head = rest[0];
    const auto content = rest.subspan(2, std::min<std::size_t>(rest[1], rest.size() - 2));
    rest = rest.subspan(2 + content.size());
    try {
      if (const auto message = assembly.add(head, content)) read(message->data, message->is_text);
    } catch (const ProtocolError&) {
    }
  }
  return 0;
}
