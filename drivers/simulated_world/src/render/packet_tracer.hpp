// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "panvo/simulated_world/camera_rays.hpp"
#include "panvo/simulated_world/renderer.hpp"
#include "shade_packet.hpp"
#include "traced_scene.hpp"

namespace panvo::simulated_world {

/// The camera pose at a moment while the shutter is open: moment 0 is the middle, for pixel centres; the others are for
/// edge samples.
struct ShutterPose {
  std::array<float, 9> world_from_camera{};  ///< rotation, row by row
  std::array<float, 3> origin{};
  float time = 0.0f;  ///< 0: opened, 1: closed
};

/// The rays and moments of sixteen samples.
struct SampleRays {
  std::array<Eigen::Vector3f, kPacket> directions;  ///< unit, optical frame
  std::array<int, kPacket> moments{};
  std::uint32_t lanes = 0;                                ///< bit mask of the lanes in use
  std::array<Eigen::Vector3f, kPacket> across{}, down{};  ///< change of the direction per column and row
  bool is_block = false;                                  ///< centres of 4 x 4 pixels: one moment and step for all
  std::uint32_t in_sun = 0, in_shadow = 0;                ///< bit masks of lanes known to be sunlit or in shadow
  float share = 1.0f;                                     ///< fraction of pixel size and shutter time covered
};

/// The results of sixteen samples.
struct SampleResults {
  std::array<std::array<float, 3>, kPacket> radiance{};
  std::array<float, kPacket> distance{};        ///< m; infinity: the sky
  std::array<std::uint32_t, kPacket> key{};     ///< 0: the sky
  std::array<std::uint32_t, kPacket> normal{};  ///< as in ShadedPacket; top bit: sunlit
};

/// The surface that a sample hits, without shading.
struct SeenSurface {
  std::uint32_t key = 0;                             ///< as in SampleResults
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< of the flat surface: unit, world frame, towards the camera
  float inverse_range = 0.0f;                        ///< 1/m
};

/// Traces and shades the samples of one frame. Thread-safe.
class PacketTracer {
 public:
  PacketTracer(const TracedScene& scene, const Sky& sky, const Light& light, const ShadingTables& tables,
               std::uint32_t visibility, std::vector<ShutterPose> moments);

  /// Counts the rays in `statistics`.
  void trace(const SampleRays& samples, SampleResults& results, Renderer::Statistics& statistics) const {
    TracedPacket packet;
    meet(samples, packet, statistics);
    shade(samples, packet, results, statistics);
  }

  /// The two parts of trace(): intersection and shading.
  void meet(const SampleRays& samples, TracedPacket& packet, Renderer::Statistics& statistics) const;
  void shade(const SampleRays& samples, const TracedPacket& packet, SampleResults& results,
             Renderer::Statistics& statistics) const;

  /// The surface that a lane hit.
  SeenSurface surface(const TracedPacket& packet, std::size_t lane) const;

  /// Distances only, m, at the moment of each lane.
  void trace_range(const SampleRays& samples, float* distances) const;

 private:
  void intersect(const SampleRays& samples, TracedPacket& packet) const;
  /// Finds what the rays hit, given their origins, directions and times. `spread`: as in TraceContext.
  void cast(TracedPacket& packet, std::uint32_t lanes, float spread) const;
  /// Shades what was hit and traces shadow rays; returns the lanes in direct light.
  std::uint32_t light_up(const SampleRays& samples, const TracedPacket& packet, ShadedPacket& shaded,
                         Renderer::Statistics& statistics) const;
  /// Adds what wet ground in the lanes of `hit` mirrors.
  void add_reflections(const SampleRays& samples, std::uint32_t hit, ShadedPacket& shaded, SampleResults& results,
                       Renderer::Statistics& statistics) const;
  void see_sky(const SampleRays& samples, const RTCRay16& rays, std::uint32_t hit, SampleResults& results) const;

  const TracedScene& scene_;
  const Sky& sky_;
  const Light& light_;
  ShadingTables tables_;
  std::uint32_t visibility_;
  std::vector<ShutterPose> moments_;
  ShadePacket shade_;
};

}  // namespace panvo::simulated_world
