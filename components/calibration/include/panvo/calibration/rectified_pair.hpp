// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/calibration/bundle.hpp"
#include "panvo/vision/camera.hpp"

namespace panvo::calibration {

/// Applies vision::rectify_view() to two cameras of a rig. Throws CalibrationError if they are not a stereo pair.
vision::RectifiedStereo rectify(const RigCamera& left, const RigCamera& right);

}  // namespace panvo::calibration
