// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "panvo/binocular_odometry/stereo_frame.hpp"
#include "panvo/vision/camera.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::binocular_odometry {

/// A textured street with road, two walls, an end wall and a ceiling, ray-traced, with known poses.
class SyntheticScene {
 public:
  static vision::RectifiedStereo stereo() { return {{220.0, 220.0, 159.5, 119.5, 320, 240}, 0.2}; }
  static constexpr std::int64_t kInterval_ns = 100'000'000;

  /// 0.12 m forward per frame, in a gentle right bend with slight pitch.
  static Eigen::Isometry3d world_from_left(int frame) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    const vision::Vector6d twist = (vision::Vector6d() << 0.004, 0.002, 0.12, 0.001, 0.006, -0.001).finished();
    for (int i = 0; i < frame; ++i) pose = pose * vision::se3_exp(twist);
    return pose;
  }

  static StereoFrame frame(int index) { return frame(index, world_from_left(index)); }

  /// `aligned_from_right`: rotation of the right camera relative to its calibration.
  static StereoFrame frame(int index, const Eigen::Isometry3d& world_from_left,
                           const Eigen::Matrix3d& aligned_from_right = Eigen::Matrix3d::Identity()) {
    Eigen::Isometry3d world_from_right = world_from_left;
    world_from_right.linear() *= aligned_from_right;
    world_from_right.translation() += world_from_left.linear() * Eigen::Vector3d(stereo().baseline_m, 0.0, 0.0);
    return {1'000'000'000 + index * kInterval_ns, draw(world_from_left), draw(world_from_right)};
  }

  static std::vector<StereoFrame> drive(int frames) {
    std::vector<StereoFrame> drive;
    for (int i = 0; i < frames; ++i) drive.push_back(frame(i));
    return drive;
  }

 private:
  static double noise(std::int64_t x, std::int64_t y, int seed) {
    auto h = static_cast<std::uint32_t>(x) * 0x8da6b343U ^ static_cast<std::uint32_t>(y) * 0xd8163841U ^
             static_cast<std::uint32_t>(seed) * 0xcb1ab31fU;
    h = (h ^ (h >> 13)) * 0x9e3779b1U;
    return static_cast<double>((h ^ (h >> 16)) & 0xffffU) / 65535.0;
  }

  // Random grey levels on a grid, smoothly interpolated.
  static double texture(double x, double y, int seed) {
    const auto column = static_cast<std::int64_t>(std::floor(x)), row = static_cast<std::int64_t>(std::floor(y));
    const auto ease = [](double t) { return t * t * (3.0 - 2.0 * t); };
    const double fx = ease(x - static_cast<double>(column)), fy = ease(y - static_cast<double>(row));
    const double above = (1.0 - fx) * noise(column, row, seed) + fx * noise(column + 1, row, seed);
    const double below = (1.0 - fx) * noise(column, row + 1, seed) + fx * noise(column + 1, row + 1, seed);
    return (1.0 - fy) * above + fy * below;
  }

  static cv::Mat draw(const Eigen::Isometry3d& world_from_camera) {
    struct Plane {
      int axis;
      double at;
    };
    static constexpr std::array<Plane, 5> kPlanes{Plane{1, 1.3}, {0, -3.0}, {0, 4.0}, {2, 14.0}, {1, -3.5}};
    const vision::PinholeCamera camera = stereo().camera;
    cv::Mat image(camera.height, camera.width, CV_8UC1);
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const Eigen::Vector3d ray = world_from_camera.linear() * camera.unproject(Eigen::Vector2d(u, v));
        const Eigen::Vector3d origin = world_from_camera.translation();
        double nearest = std::numeric_limits<double>::infinity(), grey = 0.0;
        for (size_t p = 0; p < kPlanes.size(); ++p) {
          const double along = (kPlanes[p].at - origin(kPlanes[p].axis)) / ray(kPlanes[p].axis);
          if (!(along > 0.0 && along < nearest)) continue;
          nearest = along;
          const Eigen::Vector3d point = origin + along * ray;
          const double x = point((kPlanes[p].axis + 1) % 3), y = point((kPlanes[p].axis + 2) % 3);
          const int seed = static_cast<int>(p);
          grey = 25.0 + 130.0 * texture(3.0 * x, 3.0 * y, seed) + 70.0 * texture(9.0 * x, 9.0 * y, seed + 9);
        }
        image.at<uchar>(v, u) = cv::saturate_cast<uchar>(grey);
      }
    }
    return image;
  }
};

}  // namespace panvo::binocular_odometry
