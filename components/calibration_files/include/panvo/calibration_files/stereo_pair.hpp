// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "panvo/calibration_files/camera_info.hpp"
#include "panvo/vision/stereo_calibration.hpp"

namespace panvo::calibration_files {

/// A stereo pair as a file describes it, raw and rectified.
struct CalibratedStereo {
  vision::StereoCalibration calibration;
  vision::RectifiedStereo rectified;
};

/// The pair of two CameraInfos, with their R and P. Throws FileError if they are not a pair: no baseline, different
/// projection matrices, R not a rotation.
CalibratedStereo stereo_pair(const CameraInfo& left, const CameraInfo& right);

/// CameraInfos of a rectified pair, named `left` and `right`.
std::pair<CameraInfo, CameraInfo> stereo_camera_infos(const vision::LensCamera& left, const vision::LensCamera& right,
                                                      const vision::RectifiedStereo& pair);

}  // namespace panvo::calibration_files
