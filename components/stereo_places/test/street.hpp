// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>

#include "panvo/vision/camera.hpp"

namespace panvo::stereo_places {

/// A street of walls, road and roof that end 18 m ahead of the origin, ray-traced. The seeds of the textures make the place:
/// streets of other seeds look alike, but nothing in them is equal. World: X right, Y down, Z ahead.
struct Street {
  std::array<int, 5> seeds{1, 2, 3, 4, 5};  // road, left wall, right wall, end, roof

  static vision::RectifiedStereo stereo() { return {{220.0, 220.0, 159.5, 119.5, 320, 240}, 0.3}; }

  static Street of_seed(int seed) {
    Street street;
    for (auto& one : street.seeds) one += 100 * seed;
    return street;
  }

  cv::Mat left(const Eigen::Isometry3d& world_from_left) const { return draw(world_from_left); }
  cv::Mat right(const Eigen::Isometry3d& world_from_left) const {
    return draw(world_from_left * Eigen::Translation3d(stereo().baseline_m, 0.0, 0.0));
  }

 private:
  static double noise(int x, int y, int seed) {
    auto h = static_cast<std::uint32_t>(x) * 0x8da6b343U ^ static_cast<std::uint32_t>(y) * 0xd8163841U ^
             static_cast<std::uint32_t>(seed) * 0xcb1ab31fU;
    h = (h ^ (h >> 13)) * 0x9e3779b1U;
    return static_cast<double>((h ^ (h >> 16)) & 0xffffU) / 65535.0;
  }

  // Bricks of random grey, of two sizes.
  static double texture(double x, double y, int seed) {
    const auto cell = [](double value) { return static_cast<int>(std::floor(value)); };
    return 30.0 + 130.0 * noise(cell(1.3 * x), cell(1.7 * y), seed) +
           70.0 * noise(cell(4.1 * x), cell(3.7 * y), seed + 50);
  }

  cv::Mat draw(const Eigen::Isometry3d& world_from_camera) const {
    struct Plane {
      int axis;
      double at;
    };
    static constexpr std::array<Plane, 5> kPlanes{Plane{1, 1.3}, {0, -4.0}, {0, 5.0}, {2, 18.0}, {1, -4.0}};
    const vision::PinholeCamera camera = stereo().camera;
    const Eigen::Vector3d origin = world_from_camera.translation();
    cv::Mat image(camera.height, camera.width, CV_8UC1);
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const Eigen::Vector3d ray = world_from_camera.linear() * camera.unproject(Eigen::Vector2d(u, v));
        double nearest = std::numeric_limits<double>::infinity(), grey = 0.0;
        for (std::size_t p = 0; p < kPlanes.size(); ++p) {
          const double along = (kPlanes[p].at - origin(kPlanes[p].axis)) / ray(kPlanes[p].axis);
          if (!(along > 0.0 && along < nearest)) continue;
          nearest = along;
          const Eigen::Vector3d point = origin + along * ray;
          grey = texture(point((kPlanes[p].axis + 1) % 3), point((kPlanes[p].axis + 2) % 3), seeds[p]);
        }
        image.at<uchar>(v, u) = cv::saturate_cast<uchar>(grey);
      }
    }
    return image;
  }
};

}  // namespace panvo::stereo_places
