// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <span>

#include "panvo/simulated_world/camera_rays.hpp"
#include "panvo/simulated_world/scene.hpp"

namespace panvo::simulated_world {

/// A camera while its shutter is open: it moves uniformly from `opened` to `closed`.
struct Shot {
  Eigen::Isometry3d world_from_camera_opened = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d world_from_camera_closed = Eigen::Isometry3d::Identity();
  std::uint32_t visibility = kToStereo;  ///< kind of camera
};

/// A moving object while the shutter is open.
struct MovingPlacement {
  Placement at_opening;
  Eigen::Affine3f world_from_model_closed = Eigen::Affine3f::Identity();
};

/// Ray-traces images of a scene with Embree: one ray per pixel with textures averaged over the pixel's footprint, more
/// rays at edges and holes; sunlight with shadows, skylight with ambient occlusion, reflections of the sky, haze. Uses
/// OpenCV's thread pool; the result is identical bit for bit for any number of threads.
class Renderer {
 public:
  /// Builds its own structures from the scene and shares the scene's palette and sky. Throws std::runtime_error if
  /// Embree fails.
  explicit Renderer(std::shared_ptr<const Scene> scene);
  ~Renderer();

  struct Quality {
    int edge_samples = 2;  ///< additional rays per pixel at an edge; up to 16
    int texture_taps = 3;  ///< probes along the longer axis of a footprint
  };

  /// Radiance of each pixel, CV_32FC3, linear RGB in the units of Light; black where the camera sees nothing.
  cv::Mat render(const CameraRays& rays, const Shot& shot, const Light& light, std::span<const MovingPlacement> movers,
                 const Quality& quality);

  /// Distance (m) along the ray of each pixel's centre when the shutter opens, CV_32FC1; infinity: the sky.
  cv::Mat render_range(const CameraRays& rays, const Shot& shot, std::span<const MovingPlacement> movers);

  struct Statistics {
    std::uint64_t pixels = 0, primary_rays = 0, shadow_rays = 0, triangles = 0;
  };
  /// Statistics of the last render().
  Statistics statistics() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace panvo::simulated_world
