// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "panvo/dataset_player/dataset.hpp"
#include "panvo/evaluation/trajectory.hpp"

namespace panvo::python {

namespace py = pybind11;

/// stamp_s x y z qx qy qz qw, with the quaternion as in messages: of length 1, qw not negative.
using TumRow = Eigen::Matrix<double, 8, 1>;
TumRow tum_row(std::int64_t stamp_ns, const Eigen::Isometry3d& world_from_base);

/// Trajectories as arrays of N x 8 float64: stamp_s x y z qx qy qz qw, as in a TUM file.
py::array_t<double> to_tum(const std::vector<dataset_player::GroundTruthPose>& poses);
py::array_t<double> to_tum(const evaluation::Trajectory& trajectory);

/// A trajectory argument. Throws TypeError or ValueError that names the argument and, for an invalid pose, its row.
evaluation::Trajectory trajectory_of(const py::handle& argument, const std::string& name);

}  // namespace panvo::python
