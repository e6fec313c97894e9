// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::runtime::dds {

/// What rmw_cyclonedds puts in front of each request and reply, after the encapsulation: 16 bytes, so that the members
/// behind it keep their alignment. A reply has the header of its request.
struct CycloneHeader {
  std::uint64_t client = 0;  ///< identifies the client
  std::int64_t number = 0;   ///< of the request
};

/// Removes the header from a message; nullopt if the message is too short.
std::optional<CycloneHeader> take_header(interfaces::Bytes& message);

/// The message with the header.
interfaces::Bytes with_header(const CycloneHeader& header, const interfaces::Bytes& message);

}  // namespace panvo::runtime::dds
