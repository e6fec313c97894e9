// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "panvo/simulated_world/random.hpp"

namespace panvo::simulated_world {

/// Smooth noise over the plan: values in [-1, 1], feature size `size_m`, determined by seed and purpose.
class LandNoise {
 public:
  LandNoise(std::uint64_t seed, std::string_view purpose, double size_m)
      : salt_(Random(seed, purpose).bits()), per_m_(1.0 / size_m) {}

  double at(const Eigen::Vector2d& point) const {
    const Eigen::Vector2d place = point * per_m_;
    const double column = std::floor(place.x()), row = std::floor(place.y());
    const double x = ease(place.x() - column), y = ease(place.y() - row);
    const double low = (1.0 - x) * lattice(column, row) + x * lattice(column + 1.0, row);
    const double high = (1.0 - x) * lattice(column, row + 1.0) + x * lattice(column + 1.0, row + 1.0);
    return (1.0 - y) * low + y * high;
  }

 private:
  static double ease(double t) { return t * t * (3.0 - 2.0 * t); }
  double lattice(double column, double row) const {
    const auto x = static_cast<std::uint64_t>(static_cast<std::int64_t>(column));
    const auto y = static_cast<std::uint64_t>(static_cast<std::int64_t>(row));
    return static_cast<double>(mix(mix(salt_ + x) + y) >> 11) * 0x1.0p-52 - 1.0;
  }

  std::uint64_t salt_;
  double per_m_;
};

}  // namespace panvo::simulated_world
