// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <random>
#include <string>
#include <vector>

#include "panvo/calibration/board.hpp"
#include "panvo/calibration/bundle.hpp"
#include "panvo/calibration/observations.hpp"
#include "panvo/vision/camera_model.hpp"
#include "panvo/vision/pose.hpp"

/// Simulated boards in front of known cameras.
namespace panvo::calibration::test {

inline constexpr double kDegree = 3.14159265358979323846 / 180.0;

inline vision::LensCamera lens(vision::LensModel model, double focal_px, std::vector<double> coefficients,
                               int width = 640, int height = 480) {
  const vision::PinholeCamera pinhole{focal_px, 1.004 * focal_px, 0.5 * width + 4.3, 0.5 * height - 3.1, width, height};
  auto camera = vision::lens_camera(vision::ros_name(model), coefficients, pinhole);
  camera.model = model;
  return camera;
}

inline vision::LensCamera plumb_bob() {
  return lens(vision::LensModel::kPlumbBob, 430.0, {-0.29, 0.09, 0.0006, -0.0004, 0.0});
}
inline vision::LensCamera fisheye() {
  return lens(vision::LensModel::kEquidistant, 205.0, {-0.012, 0.006, -0.002, 0.0003});
}

/// camera_from_reference of a camera at `position` (m) in the reference frame, rotated by a rotation vector in degrees.
inline Eigen::Isometry3d camera_at(const Eigen::Vector3d& position, const Eigen::Vector3d& turn_deg) {
  Eigen::Isometry3d reference_from_camera = Eigen::Isometry3d::Identity();
  reference_from_camera.translation() = position;
  reference_from_camera.linear() = vision::so3_exp(kDegree * turn_deg);
  return reference_from_camera.inverse();
}

inline std::vector<RigCamera> stereo_pair(const vision::LensCamera& lens) {
  auto right = lens;
  right.pinhole.fx *= 1.01;
  right.pinhole.fy *= 1.01;
  right.pinhole.cx -= 6.0;
  return {{lens}, {right, camera_at({0.12, 0.001, -0.002}, {0.4, -0.9, 0.6})}};
}

/// Pose of a board whose centre is `off_deg` off the camera's axis towards `azimuth_deg`, `distance_m` away, tilted by
/// `tilt_deg` about a random axis and turned at random.
inline Eigen::Isometry3d hold_board(const Board& board, const Eigen::Isometry3d& camera_from_reference, double off_deg,
                                    double azimuth_deg, double distance_m, double tilt_deg, std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const Eigen::Matrix3d towards = (Eigen::AngleAxisd(kDegree * azimuth_deg, Eigen::Vector3d::UnitZ()) *
                                   Eigen::AngleAxisd(kDegree * off_deg, Eigen::Vector3d::UnitY()) *
                                   Eigen::AngleAxisd(-kDegree * azimuth_deg, Eigen::Vector3d::UnitZ()))
                                      .toRotationMatrix();
  const Eigen::Vector3d axis = Eigen::Vector3d{any(random), any(random), 0.0}.normalized();
  Eigen::Isometry3d camera_from_board = Eigen::Isometry3d::Identity();
  camera_from_board.linear() =
      towards * Eigen::AngleAxisd(kDegree * tilt_deg, axis).toRotationMatrix() *
      Eigen::AngleAxisd(kDegree * 20.0 * any(random), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Vector3d middle = 0.5 * (board.point(0) + board.point(board.corners() - 1));
  camera_from_board.translation() = distance_m * towards.col(2) - camera_from_board.linear() * middle;
  return camera_from_reference.inverse() * camera_from_board;
}

/// Boards across the field of view of each camera in turn, at `nearest_m` to twice that distance.
inline std::vector<Eigen::Isometry3d> hold_boards(const Board& board, const std::vector<RigCamera>& cameras, int count,
                                                  double widest_off_deg, double nearest_m, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < count; ++i) {
    const auto& camera = cameras[static_cast<std::size_t>(i) % cameras.size()];
    const double off_deg = widest_off_deg * std::sqrt(share(random));
    const double distance_m = nearest_m * (1.0 + share(random)), tilt_deg = 15.0 + 30.0 * share(random);
    poses.push_back(hold_board(board, camera.camera_from_reference, off_deg, 137.5 * i, distance_m, tilt_deg, random));
  }
  return poses;
}

/// Corners seen by the cameras, with noise `noise_px`. A chessboard must be fully visible; a ChArUco board needs eight
/// visible corners.
inline Observations observe(const Board& board, const std::vector<RigCamera>& cameras,
                            const std::vector<Eigen::Isometry3d>& reference_from_board, double noise_px,
                            unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  Observations observations;
  observations.board_points = board.points();
  std::vector<vision::CameraModel> models;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    observations.cameras.push_back("camera_" + std::to_string(i));
    observations.image_sizes.emplace_back(cameras[i].lens.pinhole.width, cameras[i].lens.pinhole.height);
    models.emplace_back(cameras[i].lens);
  }
  for (std::size_t view = 0; view < reference_from_board.size(); ++view) {
    observations.views.push_back({"view_" + std::to_string(view), std::vector<std::vector<Corner>>(cameras.size())});
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      const Eigen::Isometry3d camera_from_board = cameras[i].camera_from_reference * reference_from_board[view];
      std::vector<Corner> corners;
      for (int id = 0; id < board.corners(); ++id) {
        const auto pixel = models[i].project(camera_from_board * board.point(id));
        if (!pixel || !cameras[i].lens.pinhole.contains(*pixel, 3.0)) continue;
        corners.push_back({id, *pixel + noise_px * Eigen::Vector2d{noise(random), noise(random)}});
      }
      const int needed = board.kind == Board::Kind::kChessboard ? board.corners() : 8;
      if (static_cast<int>(corners.size()) >= needed) observations.views.back().seen[i] = corners;
    }
  }
  return observations;
}

}  // namespace panvo::calibration::test
