// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <opencv2/core.hpp>

#include "panvo/vision/stereo_calibration.hpp"

namespace panvo::python {

namespace py = pybind11;

struct StereoImages {
  cv::Mat left, right;  ///< as image_of()
};

/// The images of a call, of the calibrated size. Throws TypeError or ValueError that names the argument.
StereoImages stereo_images(const vision::StereoCalibration& calibration, const py::object& left,
                           const py::object& right);

}  // namespace panvo::python
