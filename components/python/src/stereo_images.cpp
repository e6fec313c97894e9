// SPDX-License-Identifier: Apache-2.0
#include "stereo_images.hpp"

#include <fmt/format.h>

#include "arrays.hpp"

namespace panvo::python {
namespace {

cv::Mat image_of_size(const py::object& argument, const char* name, const vision::PinholeCamera& camera) {
  cv::Mat image = image_of(argument, name);
  if (image.cols != camera.width || image.rows != camera.height) {
    throw py::value_error(fmt::format("{}: expected {} x {} px (width x height) as calibrated, not {} x {}", name,
                                      camera.width, camera.height, image.cols, image.rows));
  }
  return image;
}

}  // namespace

StereoImages stereo_images(const vision::StereoCalibration& calibration, const py::object& left,
                           const py::object& right) {
  return {image_of_size(left, "left", calibration.left.pinhole),
          image_of_size(right, "right", calibration.right.pinhole)};
}

}  // namespace panvo::python
