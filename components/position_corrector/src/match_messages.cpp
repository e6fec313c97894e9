// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/match_messages.hpp"

#include <cstdint>
#include <stdexcept>

#include "panvo/conversions/time.hpp"

namespace panvo::position_corrector {
namespace {

std::uint8_t match_constant(MatchState state) {
  using namespace panvo_msgs::msg::LandmarkMatch_Constants;
  switch (state) {
    case MatchState::kSearching:
      return SEARCHING;
    case MatchState::kLocked:
      return LOCKED;
    case MatchState::kMatched:
      return MATCHED;
    case MatchState::kRejected:
      return REJECTED;
    case MatchState::kUnusable:
      return UNUSABLE;
  }
  throw std::logic_error("a state without a constant");
}

}  // namespace

panvo_msgs::msg::LandmarkMatch to_message(const LandmarkMatch& match, const std::string& panorama_frame) {
  panvo_msgs::msg::LandmarkMatch message;
  message.header().stamp(conversions::to_stamp(match.stamp_ns));
  message.header().frame_id(panorama_frame);
  message.state(match_constant(match.state));
  message.reason(match.reason);
  message.landmark_id(match.landmark_id);
  message.heading_rad(match.heading_rad);
  message.histogram_distance(match.histogram_distance);
  message.large_distance(match.large_distance);
  message.small_distance(match.small_distance);
  message.candidates(static_cast<std::uint32_t>(match.candidates));
  message.kept_after_histogram(static_cast<std::uint32_t>(match.kept_after_histogram));
  message.kept_after_large(static_cast<std::uint32_t>(match.kept_after_large));
  return message;
}

}  // namespace panvo::position_corrector
