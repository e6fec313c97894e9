// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/correction_messages.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"

namespace panvo::position_corrector {
namespace {

std::uint8_t to_constant(CorrectionState state) {
  using namespace panvo_msgs::msg::PositionCorrection_Constants;
  switch (state) {
    case CorrectionState::kFull:
      return FULL;
    case CorrectionState::kWeak:
      return WEAK;
    case CorrectionState::kRotationOnly:
      return ROTATION_ONLY;
    case CorrectionState::kRejected:
      return REJECTED;
  }
  throw std::logic_error("a state without a constant");
}

}  // namespace

panvo_msgs::msg::PositionCorrection to_message(const PositionCorrection& correction,
                                               const std::string& panorama_frame) {
  panvo_msgs::msg::PositionCorrection message;
  message.header().stamp(conversions::to_stamp(correction.stamp_ns));
  message.header().frame_id(panorama_frame);
  message.landmark_id(correction.landmark_id);
  message.state(to_constant(correction.state));
  message.reason(correction.reason);
  message.inliers(static_cast<std::uint32_t>(std::max(0, correction.inliers)));
  message.landmark_from_base().pose(conversions::to_pose(correction.pose.landmark_from_base));
  message.landmark_from_base().covariance(conversions::to_array(correction.pose.covariance));
  return message;
}

}  // namespace panvo::position_corrector
