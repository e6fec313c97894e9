// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

namespace panvo::landmark_builder {

/// Appearance of a ground pixel: log brightness and two colour ratios, or (grey) log brightness and local texture.
using GroundColour = std::array<float, 3>;

/// A mixture of Gaussians with diagonal covariances, updated online [Lu2015 4.1].
class ColourMixture {
 public:
  struct Gaussian {
    GroundColour mean{}, variance{};
    double weight = 0.0;  ///< fraction of the samples
  };

  /// `min_variance` keeps a Gaussian from shrinking to the noise of one image.
  ColourMixture(int gaussians, GroundColour min_variance);

  /// Learns from the samples of one image, which together change the weights by `rate`. A sample that no Gaussian
  /// explains replaces the one with the least weight. Deterministic; depends on the order of the samples.
  void learn(std::span<const GroundColour> samples, double rate);

  bool empty() const noexcept { return gaussians_.empty(); }
  std::span<const Gaussian> gaussians() const noexcept { return gaussians_; }

  /// Log density of each colour, approximated by its best Gaussian; `planes` are the three values of `count` pixels.
  /// Gaussians below `min_weight` are ignored.
  void log_density(const std::array<const float*, 3>& planes, int count, double min_weight, float* out) const;

 private:
  std::size_t most_;
  GroundColour min_variance_;
  std::vector<Gaussian> gaussians_;  // by descending weight
};

}  // namespace panvo::landmark_builder
