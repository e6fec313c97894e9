// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <opencv2/core.hpp>
#include <vector>

#include "panvo/vision/equirectangular.hpp"

namespace panvo::landmark_builder {

/// A grass plane with roads, and panoramas of it: each pixel has the colour of the ground point that its ray hits.
class PaintedTown {
 public:
  struct Road {
    Eigen::Vector2d from, to;
  };

  static constexpr double kHalfWidth_m = 3.25;
  static constexpr double kKerb_m = 0.3;

  explicit PaintedTown(std::vector<Road> roads) : roads_(std::move(roads)) {}

  /// Roads from one centre, `length_m` long, in these directions (rad, counter-clockwise from +x).
  static PaintedTown star(const std::vector<double>& directions_rad, double length_m = 80.0) {
    std::vector<Road> roads;
    for (const double direction : directions_rad) {
      roads.push_back({Eigen::Vector2d::Zero(), length_m * Eigen::Vector2d(std::cos(direction), std::sin(direction))});
    }
    return PaintedTown(roads);
  }

  static Eigen::Isometry3d base_from_panorama() {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    pose.translation() << -0.25, 0.05, 2.0;
    return pose;
  }

  static Eigen::Isometry3d at(double x, double y, double yaw_rad) {
    Eigen::Isometry3d pose(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
    pose.translation() << x, y, 0.0;
    return pose;
  }

  double distance_to_road(const Eigen::Vector2d& point) const {
    double nearest = 1e9;
    for (const Road& road : roads_) {
      const Eigen::Vector2d along = road.to - road.from;
      const double share = std::clamp((point - road.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (point - road.from - share * along).norm());
    }
    return nearest - kHalfWidth_m;
  }

  cv::Mat panorama(const Eigen::Isometry3d& odom_from_base, int columns = 1080) const {
    const vision::Equirectangular equirectangular{columns, columns / 2};
    const Eigen::Isometry3d odom_from_panorama = odom_from_base * base_from_panorama();
    cv::Mat image(columns / 2, columns, CV_8UC3);
    for (int row = 0; row < image.rows; ++row) {
      for (int column = 0; column < image.cols; ++column) {
        const Eigen::Vector3d ray = equirectangular.unproject({column, row});
        auto& pixel = image.at<cv::Vec3b>(row, column);
        if (ray.y() > 0.75) {
          pixel = {90, 30, 20};  // the vehicle body
          continue;
        }
        const Eigen::Vector3d direction = odom_from_panorama.linear() * ray;
        if (direction.z() > -0.02) {
          pixel = direction.z() > 0.0 ? cv::Vec3b(230, 200, 170) : cv::Vec3b(90, 120, 100);
          continue;
        }
        const Eigen::Vector3d origin = odom_from_panorama.translation();
        const Eigen::Vector2d point = (origin - direction * (origin.z() / direction.z())).head<2>();
        pixel = colour(point, 255.0 * noise(column, row));
      }
    }
    return image;
  }

 private:
  static double noise(std::int64_t a, std::int64_t b) {
    auto bits = static_cast<std::uint64_t>(a) * 0x9E3779B97F4A7C15ULL ^
                (static_cast<std::uint64_t>(b) + 0x7F4A7C15ULL) * 0xBF58476D1CE4E5B9ULL;
    bits ^= bits >> 31;
    bits *= 0x94D049BB133111EBULL;
    bits ^= bits >> 29;
    return static_cast<double>(bits >> 40) / static_cast<double>(1ULL << 24);
  }

  cv::Vec3b colour(const Eigen::Vector2d& point, double grain) const {
    const double rough = 24.0 * (noise(static_cast<std::int64_t>(std::floor(point.x() / 0.15)),
                                       static_cast<std::int64_t>(std::floor(point.y() / 0.15))) -
                                 0.5) +
                         0.02 * grain;
    const double beside = distance_to_road(point);
    const auto shade = [&](double b, double g, double r) {
      return cv::Vec3b(cv::saturate_cast<std::uint8_t>(b + rough), cv::saturate_cast<std::uint8_t>(g + rough),
                       cv::saturate_cast<std::uint8_t>(r + rough));
    };
    if (beside < 0.0) return shade(92, 92, 95);
    if (beside < kKerb_m) return shade(170, 170, 170);
    // flower beds, as recognisable features
    const double bed = 70.0 * noise(static_cast<std::int64_t>(std::floor(point.x() / 1.3)),
                                    static_cast<std::int64_t>(std::floor(point.y() / 1.3)) + 77);
    return shade(30 + 0.5 * bed, 80 + bed, 45 + 0.6 * bed);
  }

  std::vector<Road> roads_;
};

}  // namespace panvo::landmark_builder
