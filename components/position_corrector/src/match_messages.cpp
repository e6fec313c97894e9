// SPDX-License-Identifier: Apache-2.0
#include "match_messages.hpp"

#include <stdexcept>

#include "panvo/conversions/time.hpp"

namespace panvo::position_corrector {

std::string to_text(MatchState state) {
  switch (state) {
    case MatchState::kSearching:
      return "searching";
    case MatchState::kLocked:
      return "locked";
    case MatchState::kMatched:
      return "matched";
    case MatchState::kRejected:
      return "rejected";
    case MatchState::kUnusable:
      return "unusable";
  }
  throw std::logic_error("a state without a name");
}

panvo_msgs::msg::LandmarkMatch to_message(const LandmarkMatch& match, const std::string& panorama_frame) {
  panvo_msgs::msg::LandmarkMatch message;
  message.header().stamp(conversions::to_stamp(match.stamp_ns));
  message.header().frame_id(panorama_frame);
  message.state(to_text(match.state));
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
