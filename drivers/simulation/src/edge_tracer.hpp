// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "block_rays.hpp"
#include "edge_finder.hpp"
#include "packet_tracer.hpp"

namespace panvo::simulation {

/// Offsets inside a pixel, -0.5..0.5, and moments, 0..1, of the samples of an edge.
struct EdgeSample {
  float column, row, time;
};

/// The samples of an edge beside the pixel's centre: their mean is the centre, in place and time, so that the picture
/// does not shift, and no two of them have about the same column or row.
std::vector<EdgeSample> edge_samples(int count);

/// Averages over the pixels that edges cross. Most samples only ask which of the surfaces there they meet, and take
/// the light that this surface has in the nearest pixel whose centre sees it; the others are shaded.
class EdgeTracer {
 public:
  /// `centres` is what the pixels' centres see, `marks` what find_edges() says of it; moment i + 1 of `tracer` is that
  /// of sample i.
  EdgeTracer(const PacketTracer& tracer, const CameraRays& rays, const std::vector<EdgeSample>& offsets,
             const SeenSurfaces& centres, const cv::Mat& marks, Renderer::Statistics& statistics);

  /// Four rows of pixels, from `top` on, into `radiance`, which holds the centres' so far.
  void trace(int top, cv::Mat& radiance);

 private:
  struct Pending {
    float* pixel = nullptr;
    float weight = 0.0f;
    int row = 0, column = 0;
    std::uint8_t mark = 0;
  };
  struct Queue {
    SampleRays samples;
    std::array<Pending, kPacket> pending{};
    int count = 0;
  };

  void add(Queue& queue, const Pending& pending, const Eigen::Vector3f& direction, int moment,
           const BlockRays::Steps& steps);
  bool close(Queue& queue) const;
  void ask();
  void shade(Queue& queue);
  bool borrow(const Pending& pending, const SeenSurface& surface) const;

  const PacketTracer& tracer_;
  const CameraRays& rays_;
  BlockRays blocks_;
  const std::vector<EdgeSample>& offsets_;
  const SeenSurfaces& centres_;
  const cv::Mat& marks_;
  Renderer::Statistics& statistics_;
  std::vector<std::vector<std::size_t>> among_leaves_;
  std::vector<std::size_t> all_;
  Queue asked_;   // to find out what they meet
  Queue leaves_;  // to trace and shade
  Queue met_;     // traced, but of no known light
  TracedPacket met_packet_;
};

}  // namespace panvo::simulation
