// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "connection_graph.hpp"
#include "offer_table.hpp"
#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/source.hpp"
#include "parameter.hpp"

namespace panvo::web_view {

// What the server of Foxglove's WebSocket protocol sends: JSON texts, and binary frames of little-endian numbers.

using ChannelTable = OfferTable<runtime::TopicDescription>;
using ServiceTable = OfferTable<runtime::ServiceDescription>;
using Channel = Offer<runtime::TopicDescription>;
using OfferedService = Offer<runtime::ServiceDescription>;

/// How the types of messages are described to a client: ROS 2's .msg notation, or OMG IDL.
enum class SchemaNotation { kRos2msg, kOmgIdl };

enum class StatusLevel { kInfo = 0, kWarning = 1, kError = 2 };

/// `capabilities`: of the protocol, such as "clientPublish". `session` identifies this run of the server. `range`: of what
/// is played, if it can be moved.
std::string server_info(std::string_view name, const std::vector<std::string>& capabilities, std::string_view session,
                        const std::optional<runtime::StampRange>& range);
std::string status(StatusLevel level, std::string_view message);
std::string advertise(std::span<const Channel> channels, SchemaNotation notation);
std::string unadvertise(std::span<const std::uint32_t> channels);
/// Services whose types are known here.
std::string advertise_services(std::span<const OfferedService> services, SchemaNotation notation);
std::string unadvertise_services(std::span<const std::uint32_t> services);
/// `id`: of the request that is answered; empty: none.
std::string parameter_values(std::span<const Parameter> parameters, std::string_view id);
std::string service_failure(std::uint32_t service, std::uint32_t call, std::string_view why);
/// What changed from `before` to `now`.
std::string connection_graph_update(const ConnectionGraph& before, const ConnectionGraph& now);

/// Head of a message of a subscription; the payload follows. `time_ns`: of reception.
std::vector<std::uint8_t> message_head(std::uint32_t subscription, std::int64_t time_ns);

/// Head of the response to a service call; the payload follows.
std::vector<std::uint8_t> service_response_head(std::uint32_t service, std::uint32_t call);
std::vector<std::uint8_t> time_frame(std::int64_t time_ns);

enum class PlaybackStatus : std::uint8_t { kPlaying = 0, kPaused = 1, kEnded = 3 };
struct PlaybackState {
  PlaybackStatus status;
  std::int64_t time_ns;
  double speed;  ///< relative to the recorded one
};
/// `is_moved`: the time has jumped. `id`: of the request that is answered; empty: none.
std::vector<std::uint8_t> playback_frame(const PlaybackState& state, bool is_moved, std::string_view id);

std::vector<std::uint8_t> asset_frame(std::uint32_t request, std::string_view content);
std::vector<std::uint8_t> asset_failure(std::uint32_t request, std::string_view why);

}  // namespace panvo::web_view
