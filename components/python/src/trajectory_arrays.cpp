// SPDX-License-Identifier: Apache-2.0
#include "trajectory_arrays.hpp"

#include <fmt/format.h>

#include <cmath>

#include "arrays.hpp"
#include "panvo/conversions/pose.hpp"

namespace panvo::python {
namespace {

constexpr py::ssize_t kColumns = 8;

template <class Poses, class PoseOf>
py::array_t<double> rows(const Poses& poses, PoseOf pose_of) {
  py::array_t<double> array({static_cast<py::ssize_t>(poses.size()), kColumns});
  double* out = array.mutable_data();
  for (const auto& pose : poses) {
    for (const double value : tum_row(pose.stamp_ns, pose_of(pose))) *out++ = value;
  }
  return array;
}

}  // namespace

TumRow tum_row(std::int64_t stamp_ns, const Eigen::Isometry3d& world_from_base) {
  const auto pose = conversions::to_pose(world_from_base);
  const auto& p = pose.position();
  const auto& q = pose.orientation();
  return {seconds(stamp_ns), p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

py::array_t<double> to_tum(const std::vector<dataset_player::GroundTruthPose>& poses) {
  return rows(
      poses, [](const auto& pose) -> const auto& { return pose.map_from_base; });
}

py::array_t<double> to_tum(const evaluation::Trajectory& trajectory) {
  return rows(
      trajectory.poses, [](const auto& pose) -> const auto& { return pose.world_from_base; });
}

evaluation::Trajectory trajectory_of(const py::handle& argument, const std::string& name) {
  if (!py::isinstance<py::array>(argument)) {
    throw py::type_error(
        fmt::format("{}: expected a file, a folder or an array of N x 8 (stamp_s x y z qx qy qz qw), "
                    "not {}",
                    name, type_name(argument)));
  }
  const auto array = py::reinterpret_borrow<py::array>(argument);
  if (array.ndim() != 2 || array.shape(1) != kColumns) {
    throw py::value_error(
        fmt::format("{}: expected shape (N, 8) (stamp_s x y z qx qy qz qw), not {}", name, shape_text(array)));
  }
  constexpr double kRotationTolerance = 1e-3;  // as in TUM files
  const Eigen::MatrixXd values = matrix_of(array, name, array.shape(0), kColumns);
  evaluation::Trajectory trajectory{{}, "<" + name + ">", "TUM"};
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    const Eigen::Quaterniond rotation(values(i, 7), values(i, 4), values(i, 5), values(i, 6));
    if (std::abs(rotation.norm() - 1.0) > kRotationTolerance) {
      throw py::value_error(
          fmt::format("{}: row {}: the quaternion has norm {:.6g} instead of 1; the columns are "
                      "stamp_s x y z qx qy qz qw",
                      name, i, rotation.norm()));
    }
    const std::int64_t stamp_ns = std::llround(values(i, 0) * 1e9);
    if (!trajectory.poses.empty() && stamp_ns <= trajectory.poses.back().stamp_ns) {
      throw py::value_error(
          fmt::format("{}: row {}: the stamp {:.9f} s is not after the previous one", name, i, values(i, 0)));
    }
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = rotation.normalized().toRotationMatrix();
    pose.translation() = values.row(i).segment<3>(1);
    trajectory.poses.push_back({stamp_ns, pose});
  }
  return trajectory;
}

}  // namespace panvo::python
