// SPDX-License-Identifier: Apache-2.0
#include "playback.hpp"

#include "protocol_error.hpp"

namespace panvo::web_view {

std::optional<PlaybackState> state_of(const runtime::Playback& playback) {
  const auto range = playback.range();
  if (!range) return std::nullopt;
  const auto status = playback.is_paused()   ? PlaybackStatus::kPaused
                      : playback.is_at_end() ? PlaybackStatus::kEnded
                                             : PlaybackStatus::kPlaying;
  return PlaybackState{status, playback.stamp_ns().value_or(range->first_ns), playback.rate()};
}

void control(runtime::Playback& playback, const ControlPlayback& request) {
  if (!playback.range()) throw ProtocolError("nothing that can be moved is played here");
  if (!request.is_to_play) playback.pause();  // first, so that nothing is played from the new position
  if (request.speed != playback.rate()) playback.set_rate(request.speed);
  if (request.seek_ns) playback.seek(*request.seek_ns);
  if (request.is_to_play) playback.resume();
}

}  // namespace panvo::web_view
