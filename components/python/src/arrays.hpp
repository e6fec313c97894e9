// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

/// Conversion of NumPy arrays to and from the types of the algorithms. Wrong types are TypeErrors, wrong shapes and
/// values ValueErrors; both name the argument and what was expected.
namespace panvo::python {

namespace py = pybind11;

/// Name of a Python object's type, for messages: "list".
std::string type_name(const py::handle& object);

/// Shape of an array, for messages: "(480, 640)".
std::string shape_text(const py::array& array);

/// An image argument: uint8, (height, width) grey or (height, width, 3) BGR. A view, valid as long as the array, if
/// its rows are contiguous (the rows of a crop are); else a copy.
cv::Mat image_of(const py::handle& argument, const std::string& name);

/// An array over the pixels of an image, without a copy. `owner`, if any, keeps the pixels of a view.
py::array to_array(const cv::Mat& image, std::shared_ptr<const void> owner = nullptr);

/// A matrix argument of numbers with this shape; `columns` 0: a vector. All must be finite.
Eigen::MatrixXd matrix_of(const py::handle& argument, const std::string& name, py::ssize_t rows, py::ssize_t columns);

/// A 4 x 4 rigid transform; its rotation is replaced by the nearest one.
Eigen::Isometry3d transform_of(const py::handle& argument, const std::string& name);

/// Stamp of a call with `stamp_s` (float, s) or `stamp_ns` (int, ns); exactly one must be given.
std::int64_t stamp_of(const py::object& stamp_s, const py::object& stamp_ns);

inline double seconds(std::int64_t stamp_ns) { return static_cast<double>(stamp_ns) / 1e9; }

}  // namespace panvo::python
