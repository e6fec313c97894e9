// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "panvo/simulated_world/random.hpp"

namespace panvo::simulated_world {

// Tileable square noise pictures, CV_32FC1, from which the painters build surfaces.

/// Independent values in [0, 1).
cv::Mat1f white_noise(int size, Random random);

/// Smooth noise, mean 0, standard deviation 1, `cells` features along each side (different in x and y: streaks).
cv::Mat1f smooth_noise(int size, cv::Size cells, Random random);

/// Sum of smooth noises, each octave with twice the cells and `gain` times the weight; mean 0, standard deviation 1.
cv::Mat1f fractal_noise(int size, cv::Size cells, int octaves, float gain, Random random);

/// Gaussian blur that wraps around the picture's borders.
cv::Mat1f blurred(const cv::Mat1f& picture, double sigma_x, double sigma_y);
inline cv::Mat1f blurred(const cv::Mat1f& picture, double sigma) { return blurred(picture, sigma, sigma); }

/// Samples `picture` at each pixel's offset (dx, dy) in px, wrapping around the borders; 1 or 3 channels.
cv::Mat displaced(const cv::Mat& picture, const cv::Mat1f& dx, const cv::Mat1f& dy);

/// A crazy paving of `cells` x `cells` jittered seeds [Worley 1996].
struct Paving {
  cv::Mat1f to_seed;  ///< distance to the nearest seed, in cells
  cv::Mat1f to_edge;  ///< distance to the border of the stone, in cells
  cv::Mat1i stone;    ///< number of the stone
};
/// `jitter` 0: regular grid, 1: fully irregular.
Paving crazy_paving(int size, int cells, float jitter, Random random);

/// A random value in [0, 1) for a stone (or brick, or board), different for each `aspect`.
inline float chance_of(const Random& random, int number, int aspect = 0) {
  return static_cast<float>(random.part(static_cast<std::uint64_t>(number) * 16 + aspect).uniform());
}

/// 0 below `low`, 1 above `high`, smooth between.
inline float smooth_step(float low, float high, float value) {
  const float t = std::min(std::max((value - low) / (high - low), 0.0f), 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

}  // namespace panvo::simulated_world
