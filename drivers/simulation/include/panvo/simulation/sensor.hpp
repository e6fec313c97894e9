// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace panvo::simulation {

/// How an imaging sensor and its lens turn radiance into numbers.
struct SensorParameters {
  bool colour = true;                           ///< RGB, else grey
  double vignetting = 0.25;                     ///< share of the light that is lost in the corners
  double full_well = 9000.0;                    ///< electrons of a white pixel: shot noise is their square root
  double read_noise = 6.0;                      ///< electrons, rms
  double blur_px = 0.45;                        ///< deviation of the lens's point spread
  double target_brightness = 0.45;              ///< mean of the metered rows, 0..1, that exposure control aims at
  double metered_from = 0.0, metered_to = 1.0;  ///< the rows that are metered, as shares of the height: not the sky
  double exposure_lag = 0.15;                   ///< share of the way to it that it goes from frame to frame; 0: fixed
  double gamma = 2.2;
};

/// Rain and dirt on the lens.
struct LensEffects {
  double rain = 0.0;   ///< 0..1: streaks of falling drops
  double smear = 0.0;  ///< 0..1: smudges that blur and veil parts of the image, always the same parts
};

/// A camera's sensor: exposes one frame after the other and adapts its exposure to what it saw.
class Sensor {
 public:
  Sensor(const SensorParameters& parameters, const LensEffects& effects, cv::Size size, std::uint64_t seed);

  /// `radiance` CV_32FC3 linear RGB (is used up) -> CV_8UC3 RGB or CV_8UC1. `frame` counts from 0 and, with the seed,
  /// decides the noise.
  cv::Mat expose(cv::Mat& radiance, std::uint64_t frame);

  /// Adapts as expose() would, so that both eyes of a pair share one exposure: the gain that the next frame will have.
  double gain() const { return gain_; }
  void set_gain(double gain) { gain_ = gain; }

 private:
  SensorParameters parameters_;
  LensEffects effects_;
  std::uint64_t seed_;
  double gain_;
  cv::Mat vignetting_;  // CV_32FC1
  cv::Mat smear_;       // CV_32FC1, 0..1; empty without
};

}  // namespace panvo::simulation
