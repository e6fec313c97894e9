// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/calibration/bundle.hpp"
#include "panvo/vision/camera.hpp"

namespace panvo::calibration {

/// The rectified pair of two cameras side by side, whatever their lenses: both are turned by half of the rotation between them, then until
/// the baseline lies along the rows [Bouguet]. The view is the widest of which every pixel is seen by both, and at most `widest_rad`
/// across or down, beyond which a flat image shows little but stretched borders. Of the size of the raw images.
/// Throws CalibrationError: sizes that differ, right camera not to the right, no direction that both see.
vision::RectifiedStereo rectify(const RigCamera& left, const RigCamera& right, double widest_rad = 1.92);

}  // namespace panvo::calibration
