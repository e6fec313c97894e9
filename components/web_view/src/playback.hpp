// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "client_request.hpp"
#include "panvo/runtime/source.hpp"
#include "server_message.hpp"

namespace panvo::web_view {

/// What this process plays; nullopt: nothing that can be moved.
std::optional<PlaybackState> state_of(const runtime::Playback& playback);

/// Does what a client asks for. An impossible speed changes nothing, see the state. Throws ProtocolError if nothing that
/// can be moved is played.
void control(runtime::Playback& playback, const ControlPlayback& request);

}  // namespace panvo::web_view
