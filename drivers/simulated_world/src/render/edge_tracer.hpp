// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "block_rays.hpp"
#include "edge_finder.hpp"
#include "packet_tracer.hpp"

namespace panvo::simulated_world {

/// Offset within a pixel, -0.5..0.5, and shutter time, 0..1, of an edge sample.
struct EdgeSample {
  float column, row, time;
};

/// The samples of an edge pixel besides its centre. Their mean is the centre in position and time, so that the image
/// does not shift; no two of them have nearly the same column or row.
std::vector<EdgeSample> edge_samples(int count);

/// Averages over pixels that edges cross. Most samples only determine which surface they hit and reuse its radiance
/// from the nearest pixel whose centre sees it; the others are shaded.
class EdgeTracer {
 public:
  /// `centres`: surfaces at the pixel centres; `marks`: result of find_edges(). Moment i + 1 of `tracer` belongs to
  /// sample i.
  EdgeTracer(const PacketTracer& tracer, const CameraRays& rays, const std::vector<EdgeSample>& offsets,
             const SeenSurfaces& centres, const cv::Mat& marks, Renderer::Statistics& statistics);

  /// Processes four rows of pixels from `top` on in `radiance`, which holds the radiance of the centres.
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
  Queue asked_;   // to trace
  Queue leaves_;  // to trace and shade
  Queue met_;     // traced, to shade because no pixel has their radiance
  TracedPacket met_packet_;
};

}  // namespace panvo::simulated_world
