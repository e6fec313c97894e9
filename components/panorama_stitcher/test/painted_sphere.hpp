// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "panvo/panorama_stitcher/panorama_rig.hpp"

/// A sphere with a smooth analytic texture: renders the images of heads and the true panorama.
namespace panvo::panorama_stitcher {

/// Grey level 48 to 208, different in each channel; changes by up to 8 levels per degree.
inline double paint(const Eigen::Vector3d& direction, int channel) {
  const Eigen::Vector3d d = direction.normalized();
  return 128.0 + 30.0 * std::sin(9.0 * d.x() + 2.0 * d.y() + channel) +
         25.0 * std::sin(8.0 * d.y() - 5.0 * d.z() + 0.5 * channel) +
         25.0 * std::sin(11.0 * d.z() + 4.0 * d.x() * d.y());
}

template <class DirectionOf>
cv::Mat paint_image(cv::Size size, int channels, double gain, const DirectionOf& direction_of) {
  cv::Mat image(size, CV_8UC(channels), cv::Scalar::all(0));
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const std::optional<Eigen::Vector3d> direction = direction_of(Eigen::Vector2d(u, v));
      if (!direction) continue;
      for (int channel = 0; channel < channels; ++channel)
        image.ptr(v)[u * channels + channel] = cv::saturate_cast<uchar>(gain * paint(*direction, channel));
    }
  }
  return image;
}

inline cv::Mat true_panorama(int columns, int channels) {
  const vision::Equirectangular panorama{columns, columns / 2};
  return paint_image({columns, columns / 2}, channels, 1.0,
                     [&](const Eigen::Vector2d& pixel) { return std::optional(panorama.unproject(pixel)); });
}

/// Intersection of a head's ray with the sphere of the rig's radius, in the panorama frame.
inline Eigen::Vector3d seen_point(const Head& head, const Eigen::Vector3d& ray_in_head, double radius_m) {
  const Eigen::Vector3d ray = head.panorama_from_head.linear() * ray_in_head;
  if (!(radius_m > 0.0)) return ray;
  const Eigen::Vector3d from = head.panorama_from_head.translation();
  const double along = from.dot(ray);
  return from + (std::sqrt(along * along + radius_m * radius_m - from.squaredNorm()) - along) * ray;
}

/// Images of a rig at the centre of the sphere. `gains`: one for each head, or empty.
inline std::vector<cv::Mat> paint_heads(const PanoramaRig& rig, int channels, const std::vector<double>& gains = {}) {
  std::vector<cv::Mat> images(rig.images());
  for (std::size_t i = 0; i < rig.heads.size(); ++i) {
    const auto& head = rig.heads[i];
    if (images[head.image].empty())
      images[head.image] = cv::Mat(head.image_size_px, CV_8UC(channels), cv::Scalar::all(0));
    const cv::Mat picture =
        paint_image(head.region_px.size(), channels, gains.empty() ? 1.0 : gains[i], [&](const Eigen::Vector2d& pixel) {
          std::optional<Eigen::Vector3d> ray;
          if (const auto* camera = std::get_if<vision::CameraModel>(&head.lens)) {
            ray = camera->unproject(pixel);
          } else {
            ray = std::get<vision::Equirectangular>(head.lens).unproject(pixel);
          }
          if (ray) ray = seen_point(head, *ray, rig.radius_m);
          return ray;
        });
    picture.copyTo(images[head.image](head.region_px));
  }
  return images;
}

}  // namespace panvo::panorama_stitcher
