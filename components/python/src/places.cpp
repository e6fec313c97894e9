// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "parameters.hpp"
#include "place_recognition.hpp"

namespace panvo::python {
namespace {

PlaceMatch match(const PlaceRecogniser& recogniser, const py::object& panorama, const py::iterable& places) {
  const cv::Mat image = image_of(panorama, "panorama");
  const py::list list(places);  // keeps the places
  std::vector<const Place*> described;
  for (const auto& place : list) {
    if (!py::isinstance<Place>(place)) {
      throw py::type_error(fmt::format("places: expected Place objects of describe(), not {}", type_name(place)));
    }
    described.push_back(place.cast<const Place*>());
  }
  const py::gil_scoped_release release;
  return recogniser.match(image, described);
}

std::string match_text(const PlaceMatch& match) {
  if (!match.is_known) return fmt::format("<panvo.PlaceMatch unknown: {}>", match.reason);
  return fmt::format("<panvo.PlaceMatch {}: heading {:.3f} rad, score {:.2f}, {} inliers>", match.index,
                     match.heading_rad, 1.0 - match.distance, match.inliers);
}

}  // namespace

void bind_places(py::module_& module) {
  py::class_<Place>(module, "Place", "A described panorama.")
      .def_property_readonly(
          "keypoints", [](const Place& place) { return place.keypoints.size(); }, "number of SIFT features")
      .def("__repr__",
           [](const Place& place) { return fmt::format("<panvo.Place of {} keypoints>", place.keypoints.size()); });

  py::class_<PlaceMatch>(module, "PlaceMatch", "The place that a panorama shows, or why it is unknown.")
      .def_readonly("known", &PlaceMatch::is_known)
      .def_property_readonly(
          "id", [](const PlaceMatch& match) { return match.is_known ? std::optional(match.index) : std::nullopt; },
          "index in the list of places; None: unknown")
      .def_readonly("heading_rad", &PlaceMatch::heading_rad,
                    "yaw now minus yaw at the place, left positive; NaN without a similar place")
      .def_property_readonly(
          "score", [](const PlaceMatch& match) { return 1.0 - match.distance; },
          "similarity: 1 the same panorama, about 0 another place; of the most similar place if "
          "unknown")
      .def_readonly("inliers", &PlaceMatch::inliers, "keypoints that agree on one motion")
      .def_readonly("reason", &PlaceMatch::reason, "why unknown, with figures; else empty")
      .def("__repr__", &match_text)
      .def("__bool__", [](const PlaceMatch& match) { return match.is_known; });

  py::class_<PlaceRecogniser>(
      module, "Places",
      "Recognises places at any heading: compressive features, then verification by SIFT features. It needs panoramas "
      "only; positions and metric corrections are the matter of the running system.")
      .def(py::init([](const py::object& parameters, std::uint64_t seed) {
             return std::make_unique<PlaceRecogniser>(ParameterReader(parameters).read<PlaceParameters>(), seed);
           }),
           py::arg("parameters") = py::none(), py::kw_only(), py::arg("seed") = 1,
           "parameters: a dict, see parameters(). Places are comparable if their description.* parameters and the seed "
           "are equal. ValueError with each problem.")
      .def(
          "describe",
          [](const PlaceRecogniser& recogniser, const py::object& panorama) {
            const cv::Mat image = image_of(panorama, "panorama");
            const py::gil_scoped_release release;
            return recogniser.describe(image);
          },
          py::arg("panorama"), "Describes a panorama (uint8, 2:1, grey or BGR). ValueError if it is unusable.")
      .def("match", &match, py::arg("panorama"), py::arg("places"),
           "The PlaceMatch of a panorama with a list of places.")
      .def_static("parameters", &ParameterReader::describe<PlaceParameters>,
                  "Default, unit, range and description of each parameter, by name.");
}

}  // namespace panvo::python
