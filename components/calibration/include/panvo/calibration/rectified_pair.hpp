// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/calibration/bundle.hpp"
#include "panvo/vision/camera.hpp"

namespace panvo::calibration {

/// vision::rectify_view() of two cameras of a rig. Throws CalibrationError where that finds that they are no stereo pair.
vision::RectifiedStereo rectify(const RigCamera& left, const RigCamera& right);

}  // namespace panvo::calibration
