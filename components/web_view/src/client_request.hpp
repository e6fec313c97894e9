// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "parameter.hpp"

namespace panvo::web_view {

// What a client of Foxglove's WebSocket protocol sends, one struct for each operation. Ids are chosen by the client,
// except those of the server's channels and services.

struct Subscribe {
  struct One {
    std::uint32_t id, channel;
  };
  std::vector<One> subscriptions;
};
struct Unsubscribe {
  std::vector<std::uint32_t> subscriptions;
};
/// Channels on which the client will publish.
struct Advertise {
  struct One {
    std::uint32_t id;
    std::string topic, encoding, schema_name;
  };
  std::vector<One> channels;
};
struct Unadvertise {
  std::vector<std::uint32_t> channels;
};
/// A message on a channel of the client. `payload` is a part of the parsed frame.
struct Publish {
  std::uint32_t channel;
  std::span<const std::uint8_t> payload;
};
struct GetParameters {
  std::vector<std::string> names;  ///< empty: all
  std::string id;                  ///< to be repeated in the answer; empty: none
};
struct SetParameters {
  std::vector<Parameter> parameters;
  std::string id;  ///< empty: no answer wanted
};
struct WatchParameters {
  std::vector<std::string> names;
  bool is_on;
};
/// `payload` is a part of the parsed frame.
struct CallService {
  std::uint32_t service, call;
  std::string encoding;
  std::span<const std::uint8_t> payload;
};
struct WatchConnectionGraph {
  bool is_on;
};
struct FetchAsset {
  std::string uri;  ///< "package://PACKAGE/FILE"
  std::uint32_t request;
};
/// Pauses, resumes, moves or speeds up what is played.
struct ControlPlayback {
  bool is_to_play;
  double speed;  ///< relative to the recorded one
  std::optional<std::int64_t> seek_ns;
  std::string id;  ///< to be repeated in the answer
};

using ClientRequest =
    std::variant<Subscribe, Unsubscribe, Advertise, Unadvertise, Publish, GetParameters, SetParameters, WatchParameters,
                 CallService, WatchConnectionGraph, FetchAsset, ControlPlayback>;

/// Reads a text frame. Throws ProtocolError.
ClientRequest parse_text(std::string_view frame);

/// Reads a binary frame; the result refers to it. Throws ProtocolError.
ClientRequest parse_binary(std::span<const std::uint8_t> frame);

}  // namespace panvo::web_view
