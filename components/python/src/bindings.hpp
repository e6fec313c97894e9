// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

/// Each function adds one part of the module.
namespace panvo::python {

namespace py = pybind11;

void bind_errors(py::module_& module);
void bind_calibration(py::module_& module);
void bind_odometry(py::module_& module);
void bind_recording(py::module_& module);
void bind_compass(py::module_& module);
void bind_places(py::module_& module);
void bind_bag(py::module_& module);
void bind_evaluation(py::module_& module);

}  // namespace panvo::python
