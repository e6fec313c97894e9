// SPDX-License-Identifier: Apache-2.0
#include "block_rays.hpp"

#include <algorithm>

namespace panvo::simulated_world {
namespace {

Eigen::Vector3f step(const Eigen::Vector3f& from, const Eigen::Vector3f& to, int count) {
  const bool sees = !from.isZero() && !to.isZero() && count > 0;
  return sees ? Eigen::Vector3f((to - from) / static_cast<float>(count)) : Eigen::Vector3f(Eigen::Vector3f::Zero());
}

Eigen::Vector3f mean(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  if (a.isZero()) return b;
  return b.isZero() ? a : Eigen::Vector3f(0.5f * (a + b));
}

}  // namespace

void BlockRays::fill(int left, int top, SampleRays& samples) const {
  samples.lanes = 0;
  for (int i = 0; i < kPacket; ++i) {
    const int column = left + i % kBlock;
    const int row = top + i / kBlock;
    const auto& direction = at(std::min(column, rays_.width - 1), std::min(row, rays_.height - 1));
    samples.directions[static_cast<std::size_t>(i)] = direction;
    if (column < rays_.width && row < rays_.height && direction.squaredNorm() > 0.5f) samples.lanes |= 1u << i;
  }
  const auto found = steps(left, top);
  samples.across.fill(found.across);
  samples.down.fill(found.down);
  samples.moments.fill(0);
  samples.share = 1.0f;
  samples.is_block = true;
}

BlockRays::Steps BlockRays::steps(int left, int top) const {
  const int x0 = std::clamp(left, 0, std::max(0, rays_.width - kBlock));
  const int y0 = std::clamp(top, 0, std::max(0, rays_.height - kBlock));
  const int x1 = std::min(x0 + kBlock - 1, rays_.width - 1);
  const int y1 = std::min(y0 + kBlock - 1, rays_.height - 1);
  const auto& top_left = at(x0, y0);
  const auto& top_right = at(x1, y0);
  const auto& low_left = at(x0, y1);
  const auto& low_right = at(x1, y1);
  return {mean(step(top_left, top_right, x1 - x0), step(low_left, low_right, x1 - x0)),
          mean(step(top_left, low_left, y1 - y0), step(top_right, low_right, y1 - y0))};
}

}  // namespace panvo::simulated_world
