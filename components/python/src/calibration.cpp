// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "panvo/dataset_player/calibration_file.hpp"
#include "panvo/dataset_player/dataset.hpp"
#include "recording.hpp"
#include "stereo_images.hpp"
#include "stereo_pair.hpp"

namespace panvo::python {
namespace {

StereoPair rectified_pair(int width, int height, double fx, double fy, double cx, double cy, double baseline_m) {
  StereoPair pair;
  pair.rectified.camera = {fx, fy, cx, cy, width, height};
  pair.rectified.baseline_m = baseline_m;
  vision::expect_valid(pair.rectified);
  pair.raw.left.pinhole = pair.raw.right.pinhole = pair.rectified.camera;
  pair.raw.right_from_left.translation().x() = -baseline_m;
  return pair;
}

StereoPair from_camera_info(const std::filesystem::path& left, const std::filesystem::path& right) {
  const auto stereo = dataset_player::read_ros_calibration(left, right);
  return {stereo.calibration, stereo.rectified};
}

Eigen::Matrix3d camera_matrix(const StereoPair& pair) {
  const auto& camera = pair.rectified.camera;
  return (Eigen::Matrix3d() << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1).finished();
}

py::tuple rectify(const StereoPair& pair, const py::object& left, const py::object& right) {
  const auto images = stereo_images(pair.raw, left, right);
  std::pair<cv::Mat, cv::Mat> rectified;
  {
    const py::gil_scoped_release release;
    rectified = StereoRectifier(pair).rectify(images.left, images.right);
    // The arrays that are returned own their pixels.
    if (rectified.first.data == images.left.data) rectified.first = rectified.first.clone();
    if (rectified.second.data == images.right.data) rectified.second = rectified.second.clone();
  }
  return py::make_tuple(to_array(rectified.first), to_array(rectified.second));
}

std::string pair_text(const StereoPair& pair) {
  const auto& camera = pair.rectified.camera;
  return fmt::format("<panvo.StereoCalibration {} x {} px, {}, fx {:.2f} px, baseline {:.4f} m>", camera.width,
                     camera.height, pair.is_rectified() ? "rectified" : "raw", camera.fx, pair.rectified.baseline_m);
}

}  // namespace

void bind_calibration(py::module_& module) {
  py::class_<StereoPair>(module, "StereoCalibration",
                         "A stereo camera: the images as they are stored, raw or rectified, their rectification, and "
                         "the place of the left camera on the vehicle.")
      .def_static("rectified", &rectified_pair, py::arg("width"), py::arg("height"), py::arg("fx"), py::arg("fy"),
                  py::arg("cx"), py::arg("cy"), py::arg("baseline_m"),
                  "A rectified pair: one pinhole camera (px) for both images, the right one at +baseline_m along x of "
                  "the left one. ValueError with each problem.")
      .def_static("from_camera_info", &from_camera_info, py::arg("left"), py::arg("right"),
                  "Reads two ROS camera_info files, as camera_calibration and `panvo calibrate stereo` write them. "
                  "CalibrationError with file, line and key.")
      .def_static(
          "from_recording",
          [](const std::filesystem::path& path) { return expect_stereo(*open_recording(path, {}), path); },
          py::arg("path"),
          "That of a data set (KITTI, EuRoC/ASL, left and right folders) or bag, with its place on the "
          "vehicle. RecordingError, CalibrationError or BagError.")
      .def_property_readonly(
          "width", [](const StereoPair& pair) { return pair.rectified.camera.width; }, "px")
      .def_property_readonly(
          "height", [](const StereoPair& pair) { return pair.rectified.camera.height; }, "px")
      .def_property_readonly("camera_matrix", &camera_matrix, "K of both rectified images, 3 x 3, px")
      .def_property_readonly("baseline_m", [](const StereoPair& pair) { return pair.rectified.baseline_m; })
      .def_property_readonly("is_rectified", &StereoPair::is_rectified, "whether the stored images are rectified")
      .def_property(
          "base_from_left", [](const StereoPair& pair) -> Eigen::Matrix4d { return pair.base_from_left.matrix(); },
          [](StereoPair& pair, const py::object& value) {
            pair.base_from_left = transform_of(value, "base_from_left");
          },
          "pose of the left optical frame (x right, y down, z forward) on the vehicle, 4 x 4, m; the identity unless "
          "the recording places the camera")
      .def("rectify", &rectify, py::arg("left"), py::arg("right"),
           "The rectified grey images of a stored pair, (height, width) uint8.")
      .def("__repr__", &pair_text);
}

}  // namespace panvo::python
