// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "panvo/simulation/camera_rays.hpp"
#include "panvo/simulation/renderer.hpp"
#include "shade_packet.hpp"
#include "traced_scene.hpp"

namespace panvo::simulation {

/// Moments at which the shutter's time is probed: the middle, for the pixels' centres, then the samples of edges.
struct ShutterPose {
  std::array<float, 9> world_from_camera{};  ///< rotation, row by row
  std::array<float, 3> origin{};
  float time = 0.0f;  ///< 0: opened, 1: closed
};

/// Where sixteen samples lie: image columns and rows, and which moment they see.
struct SampleRays {
  std::array<Eigen::Vector3f, kPacket> directions;  ///< unit, optical frame
  std::array<int, kPacket> moments{};
  std::uint32_t lanes = 0;                                ///< bit by bit: which of the sixteen there are
  std::array<Eigen::Vector3f, kPacket> across{}, down{};  ///< what the direction gains per column and row
  bool is_block = false;                                  ///< 4 x 4 pixels' centres: one moment and one step for all
  std::uint32_t in_sun = 0, in_shadow = 0;                ///< lanes, bit by bit, of which this is known
  float share = 1.0f;                                     ///< of the pixel and of the shutter's time
};

/// What sixteen samples see.
struct SampleResults {
  std::array<std::array<float, 3>, kPacket> radiance{};
  std::array<float, kPacket> distance{};        ///< m; infinity: the sky
  std::array<std::uint32_t, kPacket> key{};     ///< 0: the sky
  std::array<std::uint32_t, kPacket> normal{};  ///< as ShadedPacket's, and the top bit: in the sun
};

/// What a sample meets, without its light.
struct SeenSurface {
  std::uint32_t key = 0;                             ///< as SampleResults'
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< of the flat surface: unit, world frame, towards the camera
  float inverse_range = 0.0f;                        ///< 1/m
};

/// Traces and shades the samples of one frame. Safe to use from many threads at once.
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

  /// trace() in two: what the samples meet, and how that looks.
  void meet(const SampleRays& samples, TracedPacket& packet, Renderer::Statistics& statistics) const;
  void shade(const SampleRays& samples, const TracedPacket& packet, SampleResults& results,
             Renderer::Statistics& statistics) const;

  /// Which surface a lane met.
  SeenSurface surface(const TracedPacket& packet, std::size_t lane) const;

  /// The distances only, m; at the moment of each lane.
  void trace_range(const SampleRays& samples, float* distances) const;

 private:
  void intersect(const SampleRays& samples, TracedPacket& packet) const;
  void see_sky(const SampleRays& samples, const RTCRay16& rays, std::uint32_t hit, SampleResults& results) const;

  const TracedScene& scene_;
  const Sky& sky_;
  const Light& light_;
  ShadingTables tables_;
  std::uint32_t visibility_;
  std::vector<ShutterPose> moments_;
  ShadePacket shade_;
};

}  // namespace panvo::simulation
