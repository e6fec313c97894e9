// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

namespace panvo::landmark_builder {

/// What a pixel of the ground looks like: log brightness and two colour ratios, or (grey) log brightness and local texture.
using GroundColour = std::array<float, 3>;

/// A mixture of Gaussians with diagonal covariances that follows its samples [Lu2015 4.1].
class ColourMixture {
 public:
  struct Gaussian {
    GroundColour mean{}, variance{};
    double weight = 0.0;  ///< share of the samples
  };

  /// `smallest_variance` keeps a Gaussian from shrinking to the noise of one picture.
  ColourMixture(int gaussians, GroundColour smallest_variance);

  /// Learns from the samples of one picture, which move the weights by `rate` in all. A sample that no Gaussian explains
  /// replaces the weakest. Deterministic: the order of the samples counts.
  void learn(std::span<const GroundColour> samples, double rate);

  bool empty() const noexcept { return gaussians_.empty(); }
  std::span<const Gaussian> gaussians() const noexcept { return gaussians_; }

  /// Log density of each colour, the best Gaussian standing for all; `planes` are the three values of `count` pixels. Gaussians
  /// below `least_weight` are not believed yet.
  void log_density(const std::array<const float*, 3>& planes, int count, double least_weight, float* out) const;

 private:
  std::size_t most_;
  GroundColour smallest_variance_;
  std::vector<Gaussian> gaussians_;  // by descending weight
};

}  // namespace panvo::landmark_builder
