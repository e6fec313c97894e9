// SPDX-License-Identifier: Apache-2.0
#include "correction_messages.hpp"

#include <algorithm>
#include <stdexcept>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"

namespace panvo::position_corrector {

std::string to_text(CorrectionState state) {
  switch (state) {
    case CorrectionState::kFull:
      return "full";
    case CorrectionState::kWeak:
      return "weak";
    case CorrectionState::kRotationOnly:
      return "rotation_only";
    case CorrectionState::kRejected:
      return "rejected";
  }
  throw std::logic_error("a state without a name");
}

panvo_msgs::msg::PositionCorrection to_message(const PositionCorrection& correction,
                                               const std::string& panorama_frame) {
  panvo_msgs::msg::PositionCorrection message;
  message.header().stamp(conversions::to_stamp(correction.stamp_ns));
  message.header().frame_id(panorama_frame);
  message.landmark_id(correction.landmark_id);
  message.state(to_text(correction.state));
  message.reason(correction.reason);
  message.inliers(static_cast<std::uint32_t>(std::max(0, correction.inliers)));
  message.landmark_from_base().pose(conversions::to_pose(correction.pose.landmark_from_base));
  message.landmark_from_base().covariance(conversions::to_array(correction.pose.covariance));
  return message;
}

}  // namespace panvo::position_corrector
