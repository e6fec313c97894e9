// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/rectified_pair.hpp"

#include <stdexcept>

#include "panvo/calibration/calibration_error.hpp"
#include "panvo/vision/stereo_calibration.hpp"

namespace panvo::calibration {

vision::RectifiedStereo rectify(const RigCamera& left, const RigCamera& right) {
  const Eigen::Isometry3d right_from_left = right.camera_from_reference * left.camera_from_reference.inverse();
  try {
    return vision::rectify_view({left.lens, right.lens, right_from_left});
  } catch (const std::invalid_argument& error) {
    throw CalibrationError(error.what());
  }
}

}  // namespace panvo::calibration
