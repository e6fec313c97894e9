// SPDX-License-Identifier: Apache-2.0
#include "observation_model.hpp"

#include "panvo/vision/pose.hpp"

namespace panvo::binocular_odometry {
namespace {

constexpr double kNearest = 1e-3;  // depth / anchor depth: nearer points count as behind the camera

Eigen::Vector3d homogeneous(const Eigen::Isometry3d& left_from_anchor, const Eigen::Vector3d& inverse_depth_point) {
  return left_from_anchor.linear() * Eigen::Vector3d(inverse_depth_point.x(), inverse_depth_point.y(), 1.0) +
         inverse_depth_point.z() * left_from_anchor.translation();
}

Eigen::Vector3d project(const vision::RectifiedStereo& stereo, const Eigen::Vector3d& h, double inverse_depth) {
  const Eigen::Vector2d pixel = stereo.camera.project(h);
  return {pixel.x(), pixel.y(), stereo.camera.fx * stereo.baseline_m * inverse_depth / h.z()};
}

}  // namespace

std::optional<Eigen::Vector3d> predict(const vision::RectifiedStereo& stereo, const Eigen::Isometry3d& left_from_anchor,
                                       const Eigen::Vector3d& inverse_depth_point) {
  const Eigen::Vector3d h = homogeneous(left_from_anchor, inverse_depth_point);
  if (!(h.z() > kNearest)) return std::nullopt;
  return project(stereo, h, inverse_depth_point.z());
}

std::optional<Prediction> predict_with_jacobians(const vision::RectifiedStereo& stereo,
                                                 const Eigen::Isometry3d& left_from_anchor,
                                                 const Eigen::Vector3d& inverse_depth_point) {
  const Eigen::Vector3d h = homogeneous(left_from_anchor, inverse_depth_point);
  if (!(h.z() > kNearest)) return std::nullopt;
  const double inverse_depth = inverse_depth_point.z(), inverse_z = 1.0 / h.z();
  const double fb = stereo.camera.fx * stereo.baseline_m;

  Eigen::Matrix3d by_h = Eigen::Matrix3d::Zero();
  by_h(0, 0) = stereo.camera.fx * inverse_z;
  by_h(0, 2) = -by_h(0, 0) * h.x() * inverse_z;
  by_h(1, 1) = stereo.camera.fy * inverse_z;
  by_h(1, 2) = -by_h(1, 1) * h.y() * inverse_z;
  by_h(2, 2) = -fb * inverse_depth * inverse_z * inverse_z;
  Eigen::Matrix3d h_by_point;
  h_by_point << left_from_anchor.linear().leftCols<2>(), left_from_anchor.translation();

  Prediction prediction;
  prediction.pixel = project(stereo, h, inverse_depth);
  prediction.by_pose.leftCols<3>() = inverse_depth * by_h;
  prediction.by_pose.rightCols<3>() = -by_h * vision::skew(h);
  prediction.by_point = by_h * h_by_point;
  prediction.by_point(2, 2) += fb * inverse_z;
  return prediction;
}

}  // namespace panvo::binocular_odometry
