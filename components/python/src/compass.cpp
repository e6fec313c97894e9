// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <mutex>
#include <utility>

#include "arrays.hpp"
#include "bindings.hpp"
#include "panvo/panoramic_compass/panoramic_compass.hpp"
#include "panvo/vision/panorama_watch.hpp"
#include "parameters.hpp"

namespace panvo::python {
namespace {

using panoramic_compass::AzimuthChange;
using panoramic_compass::CompassParameters;
using panoramic_compass::PanoramicCompass;

/// The compass with the check for repeated and flipped panoramas: what PanoramicCompassComponent does.
class Compass {
 public:
  Compass(const CompassParameters& parameters, std::uint64_t seed, const Eigen::Matrix3d& base_from_panorama)
      : compass_(parameters, seed, base_from_panorama) {}

  std::optional<AzimuthChange> turn(const py::object& panorama, const py::object& stamp_s, const py::object& stamp_ns,
                                    std::optional<double> expected_turn_rad) {
    const cv::Mat image = image_of(panorama, "panorama");
    const std::int64_t stamp = stamp_of(stamp_s, stamp_ns);
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    if (last_stamp_ns_ && stamp <= *last_stamp_ns_) {
      throw std::invalid_argument(fmt::format("stamp: {:.9f} s is not later than the previous one, {:.9f} s",
                                              seconds(stamp), seconds(*last_stamp_ns_)));
    }
    const auto before_ns = std::exchange(last_stamp_ns_, stamp);
    if (const auto fault = watch_.add(image); fault && before_ns && !panoramic_compass::find_fault(image)) {
      return AzimuthChange{.from_stamp_ns = *before_ns, .stamp_ns = stamp, .reason = "the panorama " + *fault};
    }
    return compass_.track(stamp, image, expected_turn_rad);
  }

 private:
  std::mutex mutex_;  // guards all below: threads may share the object
  PanoramicCompass compass_;
  vision::PanoramaWatch watch_;
  std::optional<std::int64_t> last_stamp_ns_;
};

std::string turn_text(const AzimuthChange& turn) {
  constexpr double kDegrees = 180.0 / 3.14159265358979323846;
  return fmt::format("<panvo.Turn {:.3f} s to {:.3f} s: {}>", seconds(turn.from_stamp_ns), seconds(turn.stamp_ns),
                     turn.valid ? fmt::format("{:.3f} deg", turn.change_rad * kDegrees) : "invalid: " + turn.reason);
}

}  // namespace

void bind_compass(py::module_& module) {
  py::class_<AzimuthChange>(module, "Turn", "Turn of the vehicle between two panoramas.")
      .def_readonly("from_stamp_ns", &AzimuthChange::from_stamp_ns,
                    "of the earlier panorama: the previous one, or a reference kept over several")
      .def_readonly("stamp_ns", &AzimuthChange::stamp_ns)
      .def_property_readonly("from_stamp_s", [](const AzimuthChange& turn) { return seconds(turn.from_stamp_ns); })
      .def_property_readonly("stamp_s", [](const AzimuthChange& turn) { return seconds(turn.stamp_ns); })
      .def_readonly("turn_rad", &AzimuthChange::change_rad, "later minus earlier yaw, left positive")
      .def_readonly("variance_rad2", &AzimuthChange::variance_rad2)
      .def_readonly("side_parallax_rad", &AzimuthChange::side_parallax_rad)
      .def_readonly("motion_azimuth_rad", &AzimuthChange::motion_azimuth_rad,
                    "direction of motion relative to the forward axis, left positive")
      .def_readonly("motion_azimuth_variance_rad2", &AzimuthChange::motion_azimuth_variance_rad2, "0: unknown")
      .def_readonly("valid", &AzimuthChange::valid)
      .def_readonly("reason", &AzimuthChange::reason, "why not valid; else empty")
      .def("__repr__", &turn_text);

  py::class_<Compass>(module, "Compass",
                      "Measures turns from panoramas alone, as the panoramic compass of `panvo run`. Threads may share "
                      "an object.")
      .def(py::init([](const py::object& parameters, std::uint64_t seed, const py::object& base_from_panorama) {
             const auto read = ParameterReader(parameters).read<CompassParameters>();
             const Eigen::Matrix3d rotation = base_from_panorama.is_none()
                                                  ? panoramic_compass::upright_base_from_panorama()
                                                  : transform_of(base_from_panorama, "base_from_panorama").linear();
             return std::make_unique<Compass>(read, seed, rotation);
           }),
           py::arg("parameters") = py::none(), py::kw_only(), py::arg("seed") = 1,
           py::arg("base_from_panorama") = py::none(),
           "base_from_panorama: pose of the camera (x right, y down, z forward) on the vehicle, 4 x 4; default: "
           "upright, looking forward. parameters: a dict, see parameters(). ValueError with each problem.")
      .def("turn", &Compass::turn, py::arg("panorama"), py::arg("stamp_s") = py::none(), py::kw_only(),
           py::arg("stamp_ns") = py::none(), py::arg("expected_turn_rad") = py::none(),
           "The Turn up to this panorama (uint8, 2:1, grey or BGR); None up to the first usable one. An unusable "
           "panorama gives a Turn that is not valid, with the reason. ValueError if the stamp is not later.")
      .def_static("parameters", &ParameterReader::describe<CompassParameters>,
                  "Default, unit, range and description of each parameter, by name.");
}

}  // namespace panvo::python
