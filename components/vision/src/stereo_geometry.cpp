// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/stereo_geometry.hpp"

namespace panvo::vision {

Eigen::Vector3d observe(const RectifiedStereo& stereo, const Eigen::Vector3d& point_in_left) {
  const Eigen::Vector2d pixel = stereo.camera.project(point_in_left);
  return {pixel.x(), pixel.y(), stereo.camera.fx * stereo.baseline_m / point_in_left.z()};
}

std::optional<Eigen::Vector3d> triangulate(const RectifiedStereo& stereo, const Eigen::Vector3d& observation_px) {
  if (!(observation_px.z() > 0.0)) return std::nullopt;
  return stereo.camera.fx * stereo.baseline_m / observation_px.z() * stereo.camera.unproject(observation_px.head<2>());
}

Eigen::Matrix3d triangulation_covariance(const RectifiedStereo& stereo, const Eigen::Vector3d& observation_px,
                                         const Eigen::Vector3d& sigma_px) {
  const double d = observation_px.z();
  const double z = stereo.camera.fx * stereo.baseline_m / d;
  const Eigen::Vector3d ray = stereo.camera.unproject(observation_px.head<2>());
  Eigen::Matrix3d by_observation = Eigen::Matrix3d::Zero();
  by_observation(0, 0) = z / stereo.camera.fx;
  by_observation(1, 1) = z / stereo.camera.fy;
  by_observation.col(2) = -z / d * ray;
  return by_observation * sigma_px.cwiseAbs2().asDiagonal() * by_observation.transpose();
}

Eigen::Vector3d inverse_depth_point(const RectifiedStereo& stereo, const Eigen::Vector3d& observation_px) {
  Eigen::Vector3d point = stereo.camera.unproject(observation_px.head<2>());
  point.z() = observation_px.z() / (stereo.camera.fx * stereo.baseline_m);
  return point;
}

Eigen::Vector3d surface_plane(const RectifiedStereo& stereo, const Eigen::Vector3d& observation_px,
                              const Eigen::Vector2d& disparity_gradient) {
  const PinholeCamera& camera = stereo.camera;
  const double at_principal_point = observation_px.z() + disparity_gradient.x() * (camera.cx - observation_px.x()) +
                                    disparity_gradient.y() * (camera.cy - observation_px.y());
  return Eigen::Vector3d(disparity_gradient.x() * camera.fx, disparity_gradient.y() * camera.fy, at_principal_point) /
         (camera.fx * stereo.baseline_m);
}

Eigen::Vector2d disparity_gradient(const RectifiedStereo& stereo, const Eigen::Vector3d& plane) {
  return {stereo.baseline_m * plane.x(), stereo.baseline_m * plane.y() * stereo.camera.fx / stereo.camera.fy};
}

std::optional<Eigen::Vector3d> transform_plane(const Eigen::Isometry3d& b_from_a, const Eigen::Vector3d& plane_in_a) {
  const Eigen::Vector3d turned = b_from_a.linear() * plane_in_a;
  const double distance = 1.0 + turned.dot(b_from_a.translation());
  if (!(distance > 1e-3)) return std::nullopt;
  return turned / distance;
}

}  // namespace panvo::vision
