// SPDX-License-Identifier: Apache-2.0
#include "arrays.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "panvo/vision/pose.hpp"

namespace panvo::python {
namespace {

constexpr py::ssize_t kColours = 3;

/// Copies an image with any strides.
cv::Mat packed(const py::array& array, int channels) {
  cv::Mat copy(static_cast<int>(array.shape(0)), static_cast<int>(array.shape(1)), CV_8UC(channels));
  const auto* data = static_cast<const std::uint8_t*>(array.data());
  const py::ssize_t channel_step = channels == 1 ? 0 : array.strides(2);
  for (int row = 0; row < copy.rows; ++row) {
    auto* out = copy.ptr<std::uint8_t>(row);
    for (int column = 0; column < copy.cols; ++column) {
      const auto* pixel = data + row * array.strides(0) + column * array.strides(1);
      for (int channel = 0; channel < channels; ++channel) *out++ = pixel[channel * channel_step];
    }
  }
  return copy;
}

std::string wanted_shape(py::ssize_t rows, py::ssize_t columns) {
  return columns == 0 ? fmt::format("({},)", rows) : fmt::format("({}, {})", rows, columns);
}

}  // namespace

std::string type_name(const py::handle& object) {
  return py::str(py::type::handle_of(object).attr("__name__")).cast<std::string>();
}

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")).cast<std::string>(); }

cv::Mat image_of(const py::handle& argument, const std::string& name) {
  if (!py::isinstance<py::array>(argument)) {
    throw py::type_error(fmt::format("{}: expected a NumPy array of uint8, not {}", name, type_name(argument)));
  }
  const auto array = py::reinterpret_borrow<py::array>(argument);
  if (array.dtype().kind() != 'u' || array.itemsize() != 1) {
    throw py::type_error(
        fmt::format("{}: expected dtype uint8, not {}", name, py::str(array.dtype()).cast<std::string>()));
  }
  const bool is_grey = array.ndim() == 2;
  constexpr py::ssize_t kMaxSide_px = 1 << 16;
  if ((!is_grey && (array.ndim() != 3 || array.shape(2) != kColours)) || array.size() == 0 ||
      array.shape(0) > kMaxSide_px || array.shape(1) > kMaxSide_px) {
    throw py::value_error(
        fmt::format("{}: expected shape (height, width) or (height, width, 3), not {}", name, shape_text(array)));
  }
  const int channels = is_grey ? 1 : kColours;
  const py::ssize_t row_bytes = array.shape(1) * channels;
  const bool has_whole_rows = array.strides(1) == channels && (is_grey || array.strides(2) == 1) &&
                              (array.strides(0) >= row_bytes || array.shape(0) == 1);
  if (!has_whole_rows) return packed(array, channels);
  // cv::Mat has no constant pixels; the algorithms only read.
  auto* data = const_cast<void*>(array.data());
  const auto step = static_cast<std::size_t>(std::max(array.strides(0), row_bytes));
  return {static_cast<int>(array.shape(0)), static_cast<int>(array.shape(1)), CV_8UC(channels), data, step};
}

py::array to_array(const cv::Mat& image, std::shared_ptr<const void> owner) {
  using Kept = std::pair<cv::Mat, std::shared_ptr<const void>>;
  auto kept = std::make_unique<Kept>(image, std::move(owner));
  const py::capsule base(kept.get(), [](void* pointer) { delete static_cast<Kept*>(pointer); });
  auto* pixels = kept.release()->first.data;
  const auto step = static_cast<py::ssize_t>(image.step[0]);
  std::vector<py::ssize_t> shape{image.rows, image.cols}, strides{step, image.channels()};
  if (image.channels() > 1) {
    shape.push_back(image.channels());
    strides.push_back(1);
  }
  return {py::dtype::of<std::uint8_t>(), shape, strides, pixels, base};
}

Eigen::MatrixXd matrix_of(const py::handle& argument, const std::string& name, py::ssize_t rows, py::ssize_t columns) {
  using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
  const auto numbers = Numbers::ensure(argument);
  if (!numbers) {
    PyErr_Clear();
    throw py::type_error(fmt::format("{}: expected an array of numbers of shape {}, not {}", name,
                                     wanted_shape(rows, columns), type_name(argument)));
  }
  const bool has_shape = columns == 0 ? numbers.ndim() == 1 && numbers.shape(0) == rows
                                      : numbers.ndim() == 2 && numbers.shape(0) == rows && numbers.shape(1) == columns;
  if (!has_shape) {
    throw py::value_error(
        fmt::format("{}: expected shape {}, not {}", name, wanted_shape(rows, columns), shape_text(numbers)));
  }
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::MatrixXd matrix = Eigen::Map<const RowMajor>(numbers.data(), rows, columns == 0 ? 1 : columns);
  if (!matrix.allFinite()) throw py::value_error(fmt::format("{}: expected finite numbers", name));
  return matrix;
}

Eigen::Isometry3d transform_of(const py::handle& argument, const std::string& name) {
  constexpr double kTolerance = 1e-3;  // digits of a file
  const Eigen::Matrix4d matrix = matrix_of(argument, name, 4, 4);
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  if ((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm() > kTolerance ||
      rotation.determinant() < 0.0 || !matrix.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), kTolerance)) {
    throw py::value_error(
        fmt::format("{}: expected a rigid transform: a rotation and a translation above the row 0 0 0 1", name));
  }
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.linear() = vision::nearest_rotation(rotation);
  transform.translation() = matrix.topRightCorner<3, 1>();
  return transform;
}

std::int64_t stamp_of(const py::object& stamp_s, const py::object& stamp_ns) {
  if (stamp_s.is_none() == stamp_ns.is_none()) throw py::type_error("expected either stamp_s or stamp_ns");
  if (!stamp_ns.is_none()) {
    if (!PyIndex_Check(stamp_ns.ptr())) {
      throw py::type_error(fmt::format("stamp_ns: expected an int, not {}", type_name(stamp_ns)));
    }
    const auto value = py::int_(stamp_ns);
    const long long ns = PyLong_AsLongLong(value.ptr());
    if (ns == -1 && PyErr_Occurred()) {
      PyErr_Clear();
      throw py::value_error("stamp_ns: does not fit into 64 bits");
    }
    return ns;
  }
  if (!PyNumber_Check(stamp_s.ptr())) {
    throw py::type_error(fmt::format("stamp_s: expected a number, not {}", type_name(stamp_s)));
  }
  const double value_s = py::float_(stamp_s);
  constexpr double kMax_s = 9.2e9;
  if (!(std::abs(value_s) <= kMax_s)) {
    throw py::value_error(fmt::format("stamp_s: expected seconds of at most {:g}, not {}", kMax_s, value_s));
  }
  return std::llround(value_s * 1e9);
}

}  // namespace panvo::python
