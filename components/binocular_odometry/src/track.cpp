// SPDX-License-Identifier: Apache-2.0
#include "track.hpp"

#include <Eigen/LU>

namespace panvo::binocular_odometry {
namespace {
constexpr double kMaxArea = 9.0;  // three times the side length
}

std::optional<ExpectedPatch> expect(const vision::RectifiedStereo& stereo, const Track& track,
                                    const Eigen::Isometry3d& current_from_host) {
  const vision::PinholeCamera& camera = stereo.camera;
  // The homography of the plane maps host rays to current rays: X = z ray and n . X = 1 give X' / z = (R + t n^T) ray.
  const Eigen::Matrix3d homography =
      current_from_host.linear() + current_from_host.translation() * track.host_plane.transpose();
  const Eigen::Vector3d h = homography * camera.unproject(track.host_pixel);
  if (!(h.z() > 1e-3)) return std::nullopt;
  ExpectedPatch expected;
  expected.pixel = camera.project(h);
  if (!camera.contains(expected.pixel)) return std::nullopt;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector3d d = homography.col(axis) / (axis == 0 ? camera.fx : camera.fy);
    expected.current_from_host(0, axis) = camera.fx * (d.x() - h.x() / h.z() * d.z()) / h.z();
    expected.current_from_host(1, axis) = camera.fy * (d.y() - h.y() / h.z() * d.z()) / h.z();
  }
  const double area = expected.current_from_host.determinant();
  if (!(area > 1.0 / kMaxArea && area < kMaxArea)) return std::nullopt;

  const auto plane = vision::transform_plane(current_from_host, track.host_plane);
  if (!plane) return std::nullopt;
  expected.gradient = vision::disparity_gradient(stereo, *plane);
  expected.disparity_px = camera.fx * stereo.baseline_m * plane->dot(camera.unproject(expected.pixel));
  return expected;
}

}  // namespace panvo::binocular_odometry
