// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <mutex>

#include "arrays.hpp"
#include "bindings.hpp"
#include "recording.hpp"
#include "trajectory_arrays.hpp"

namespace panvo::python {
namespace {

struct StereoFrame {
  std::int64_t stamp_ns = 0;
  py::array left, right;
};

struct PanoramaFrame {
  std::int64_t stamp_ns = 0;
  py::array image;
};

/// A Python iterator over a part of a recording; threads may share it.
class Frames {
 public:
  explicit Frames(std::unique_ptr<FrameReader> reader) : reader_(std::move(reader)) {}

  py::object next() {
    std::vector<std::string> warnings;
    std::optional<RecordedFrame> frame;
    {
      const py::gil_scoped_release release;
      const std::lock_guard lock(mutex_);
      frame = reader_->next(warnings);
    }
    for (const auto& warning : warnings) {
      if (PyErr_WarnEx(PyExc_RuntimeWarning, warning.c_str(), 1) != 0) throw py::error_already_set();
    }
    if (!frame) throw py::stop_iteration();
    const auto array = [&](std::size_t index) {
      auto& image = frame->images[index];
      return to_array(image.pixels, std::move(image.owner));
    };
    if (frame->is_panorama()) return py::cast(PanoramaFrame{frame->stamp_ns, array(0)});
    return py::cast(StereoFrame{frame->stamp_ns, array(0), array(1)});
  }

 private:
  std::mutex mutex_;
  std::unique_ptr<FrameReader> reader_;
};

using Opened = std::shared_ptr<const Recording>;

/// The Python object: a shared recording.
struct RecordingHandle {
  Opened recording;
};

RecordingHandle open(const std::filesystem::path& path, double rate_hz, const std::filesystem::path& calibration,
                     const std::map<std::string, std::string>& topics) {
  const py::gil_scoped_release release;
  return {open_recording(path, {.folder = {.rate_hz = rate_hz, .calibration = calibration}, .topics = topics})};
}

std::unique_ptr<Frames> frames(const RecordingHandle& handle, const Part& part) {
  if (!(part.start_s >= 0.0)) throw py::value_error(fmt::format("start_s: expected 0 or more, not {}", part.start_s));
  if (!(part.duration_s >= 0.0)) {
    throw py::value_error(fmt::format("duration_s: expected 0 or more, not {}", part.duration_s));
  }
  const py::gil_scoped_release release;
  return std::make_unique<Frames>(handle.recording->read(part));
}

template <bool stereo, bool panoramas>
std::unique_ptr<Frames> frames_of(const RecordingHandle& handle, double start_s, double duration_s) {
  return frames(handle, {.start_s = start_s, .duration_s = duration_s, .stereo = stereo, .panoramas = panoramas});
}

std::string recording_text(const RecordingHandle& handle) {
  const auto& recording = *handle.recording;
  return fmt::format("<panvo.Recording {}: {}{}{}{}>", recording.path.string(), recording.kind,
                     recording.stereo ? ", stereo" : "", recording.base_from_panorama ? ", panoramas" : "",
                     recording.ground_truth.empty() ? "" : ", ground truth");
}

void bind_frames(py::module_& module) {
  py::class_<StereoFrame>(module, "StereoFrame", "A stereo pair of a recording: uint8, grey or BGR, as stored.")
      .def_readonly("stamp_ns", &StereoFrame::stamp_ns)
      .def_property_readonly("stamp_s", [](const StereoFrame& frame) { return seconds(frame.stamp_ns); })
      .def_readonly("left", &StereoFrame::left)
      .def_readonly("right", &StereoFrame::right);
  py::class_<PanoramaFrame>(module, "PanoramaFrame", "A panorama of a recording: uint8, grey or BGR, 2:1.")
      .def_readonly("stamp_ns", &PanoramaFrame::stamp_ns)
      .def_property_readonly("stamp_s", [](const PanoramaFrame& frame) { return seconds(frame.stamp_ns); })
      .def_readonly("image", &PanoramaFrame::image);
  py::class_<Frames>(module, "Frames", "Iterator over a part of a recording.")
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__", &Frames::next);
}

}  // namespace

void bind_recording(py::module_& module) {
  bind_frames(module);
  const auto start = py::arg("start_s") = 0.0;
  const auto duration = py::arg("duration_s") = 0.0;
  py::class_<RecordingHandle>(
      module, "Recording",
      "A data set (KITTI odometry, EuRoC/ASL, left and right folders) or a bag. Iterating gives "
      "StereoFrame and PanoramaFrame in order; unreadable images are skipped with a "
      "RuntimeWarning.")
      .def(py::init(&open), py::arg("path"), py::kw_only(), py::arg("rate_hz") = 0.0,
           py::arg("calibration") = std::filesystem::path(), py::arg("topics") = std::map<std::string, std::string>(),
           "rate_hz: of data sets without times. calibration: folder, for left and right folders without one. topics: "
           "of a bag, by role: left, right, left_info, right_info, panorama, ground_truth, tf_static. RecordingError, "
           "CalibrationError or BagError.")
      .def_property_readonly("kind", [](const RecordingHandle& handle) { return handle.recording->kind; })
      .def_property_readonly("path", [](const RecordingHandle& handle) { return handle.recording->path; })
      .def_property_readonly(
          "notes", [](const RecordingHandle& handle) { return handle.recording->notes; },
          "warnings: skipped frames, an assumed frame rate")
      .def_property_readonly(
          "calibration", [](const RecordingHandle& handle) { return handle.recording->stereo; },
          "StereoCalibration, or None")
      .def_property_readonly(
          "base_from_panorama",
          [](const RecordingHandle& handle) -> std::optional<Eigen::Matrix4d> {
            const auto& pose = handle.recording->base_from_panorama;
            return pose ? std::optional<Eigen::Matrix4d>(pose->matrix()) : std::nullopt;
          },
          "pose of the panoramic camera (x right, y down, z forward) on the vehicle, 4 x 4; None without panoramas")
      .def_property_readonly(
          "ground_truth", [](const RecordingHandle& handle) { return to_tum(handle.recording->ground_truth); },
          "trajectory, N x 8: stamp_s x y z qx qy qz qw; N is 0 without ground truth")
      .def("stereo", &frames_of<true, false>, start, duration,
           "Stereo frames from start_s after the first image on; duration_s 0: to the end.")
      .def("panoramas", &frames_of<false, true>, start, duration, "Panorama frames, likewise.")
      .def("frames", &frames_of<true, true>, start, duration, "Both, likewise.")
      .def("__iter__", [](const RecordingHandle& handle) { return frames(handle, {}); })
      .def("__repr__", &recording_text);
}

}  // namespace panvo::python
