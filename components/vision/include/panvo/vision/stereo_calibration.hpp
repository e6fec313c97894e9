// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "panvo/vision/camera.hpp"
#include "panvo/vision/lens.hpp"

namespace panvo::vision {

/// Two raw cameras, whatever their lenses, and the transform between their optical frames, as a calibration tool writes them.
struct StereoCalibration {
  LensCamera left;
  LensCamera right;
  Eigen::Isometry3d right_from_left = Eigen::Isometry3d::Identity();
};

/// What is wrong with a calibration, one sentence a problem; empty when it can be used. Found are: focal lengths that are not positive
/// numbers, sizes that differ or are not positive, coefficients that are not numbers, a baseline that is zero, negative (left and right
/// exchanged), not a number or not along the rows, rotations that are no rotations.
std::vector<std::string> validate(const StereoCalibration& calibration);

/// Whether the images of that pair are rectified as they are: perspective lenses without distortion, no rotation, one camera matrix,
/// baseline along X.
bool is_rectified(const StereoCalibration& calibration);

/// Rectified pair of a raw one, at the raw images' size: itself when it is rectified already; of plumb_bob lenses as OpenCV's
/// stereoRectify has it, zoomed so that every rectified pixel has a source; of all others rectify_view().
/// Throws std::invalid_argument, naming each problem that validate() finds, and where rectify_view does.
RectifiedStereo rectify(const StereoCalibration& calibration);

/// The rectified pair of two cameras side by side, whatever their lenses: both are turned by half of the rotation between them, then
/// until the baseline lies along the rows [Bouguet]. The view is the widest of which every pixel is seen by both, and at most
/// 110 degrees across or down, beyond which a flat image shows little but stretched borders. Of the size of the raw images.
/// Throws std::invalid_argument: sizes that differ, right camera not to the right, a lens that CameraModel refuses, no direction
/// that both see.
RectifiedStereo rectify_view(const StereoCalibration& calibration);

}  // namespace panvo::vision
