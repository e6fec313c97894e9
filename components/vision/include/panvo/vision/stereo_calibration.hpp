// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "panvo/vision/camera.hpp"
#include "panvo/vision/lens.hpp"

namespace panvo::vision {

/// Two raw cameras with any lenses, and the transform between their optical frames.
struct StereoCalibration {
  LensCamera left;
  LensCamera right;
  Eigen::Isometry3d right_from_left = Eigen::Isometry3d::Identity();
};

/// Lists the problems of a calibration, one sentence each; empty if it is valid. Checks intrinsics, image sizes
/// (positive, equal), distortion coefficients, the baseline (positive, along the rows; negative if left and right are
/// swapped) and the rotation matrix.
std::vector<std::string> validate(const StereoCalibration& calibration);

/// Whether the pair is already rectified: perspective lenses without distortion, no rotation, equal camera matrices,
/// baseline along X.
bool is_rectified(const StereoCalibration& calibration);

/// Rectifies a raw pair, keeping the image size. An already rectified pair is returned unchanged; two plumb_bob lenses
/// use OpenCV's stereoRectify, zoomed so that every rectified pixel has a source; all others use rectify_view(). Throws
/// std::invalid_argument with each problem that validate() finds, and where rectify_view() does.
RectifiedStereo rectify(const StereoCalibration& calibration);

/// Rectifies a side-by-side pair with any lenses, keeping the image size: each camera is rotated by half of the
/// relative rotation, then both so that the baseline lies along the rows [Bouguet]. The view is the widest in which
/// both cameras see every pixel, at most 110 degrees across or down (wider perspective images are mostly stretched
/// borders). Throws std::invalid_argument if the sizes differ, the right camera is not to the right, CameraModel
/// rejects a lens, or the fields of view do not overlap.
RectifiedStereo rectify_view(const StereoCalibration& calibration);

}  // namespace panvo::vision
