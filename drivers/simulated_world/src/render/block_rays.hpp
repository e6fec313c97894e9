// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <utility>

#include "packet_tracer.hpp"
#include "panvo/simulated_world/camera_rays.hpp"

namespace panvo::simulated_world {

inline constexpr int kBlock = 4;  ///< a packet is 4 x 4 pixels

/// The rays of a camera in blocks, with their changes from pixel to pixel.
class BlockRays {
 public:
  explicit BlockRays(const CameraRays& rays) : rays_(rays) {}

  /// Fills in the rays of a block's pixel centres; lanes outside the image or without a ray are disabled.
  void fill(int left, int top, SampleRays& samples) const;

  /// Change of the direction per column and per row, averaged over the block.
  struct Steps {
    Eigen::Vector3f across = Eigen::Vector3f::Zero(), down = Eigen::Vector3f::Zero();
  };
  Steps steps(int left, int top) const;

  const Eigen::Vector3f& at(int column, int row) const {
    return rays_.directions[static_cast<std::size_t>(row) * static_cast<std::size_t>(rays_.width) +
                            static_cast<std::size_t>(column)];
  }

 private:
  const CameraRays& rays_;
};

}  // namespace panvo::simulated_world
