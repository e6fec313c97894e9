// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/reconnection.hpp"

#include <algorithm>

namespace panvo::camera_stream {

Reconnection::Action Reconnection::step(std::int64_t now_ns) {
  if (state_ == State::kWaiting && now_ns >= next_try_ns_) {
    state_ = State::kOpening;
    return Action::kOpen;
  }
  if (state_ == State::kStreaming) {
    if (is_gone_) return close(Loss::kDeviceGone, now_ns);
    count_silence(now_ns);
    if (is_silent()) return close(Loss::kNoFrames, now_ns);
  }
  return Action::kNone;
}

void Reconnection::count_silence(std::int64_t now_ns) {
  silent_ns_ += std::min(now_ns - watched_ns_, settings_.watchdog_ns / 4);
  watched_ns_ = now_ns;
}

bool Reconnection::is_silent() const { return settings_.watchdog_ns > 0 && silent_ns_ > settings_.watchdog_ns; }

void Reconnection::sign_of_life(std::int64_t now_ns) {
  watched_ns_ = now_ns;
  silent_ns_ = 0;
}

Reconnection::Action Reconnection::close(Loss loss, std::int64_t now_ns) {
  state_ = State::kWaiting;
  last_loss_ = loss;
  next_try_ns_ = now_ns;
  has_been_lost_ = has_been_lost_ || has_streamed_;
  return Action::kClose;
}

void Reconnection::opened(std::int64_t now_ns) {
  state_ = State::kStreaming;
  sign_of_life(now_ns);
  is_gone_ = false;
  has_streamed_ = false;
}

void Reconnection::failed(std::int64_t now_ns) {
  state_ = State::kWaiting;
  next_try_ns_ = now_ns + settings_.retry_ns;
}

void Reconnection::frame(std::int64_t now_ns) {
  sign_of_life(now_ns);
  if (!has_streamed_ && has_been_lost_) ++reconnects_;
  has_streamed_ = true;
}

void Reconnection::device_gone() { is_gone_ = true; }

std::string_view name_of(Reconnection::State state) {
  switch (state) {
    case Reconnection::State::kWaiting:
      return "not connected";
    case Reconnection::State::kOpening:
      return "being opened";
    case Reconnection::State::kStreaming:
      return "streaming";
  }
  return "unknown";
}

}  // namespace panvo::camera_stream
