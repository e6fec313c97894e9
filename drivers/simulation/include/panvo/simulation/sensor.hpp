// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace panvo::simulation {

/// How an imaging sensor and its lens convert radiance to pixel values.
struct SensorParameters {
  bool colour = true;                           ///< RGB, else grey
  double vignetting = 0.25;                     ///< fraction of the light lost in the corners
  double full_well = 9000.0;                    ///< electrons of a white pixel; shot noise is their square root
  double read_noise = 6.0;                      ///< electrons, rms
  double blur_px = 0.45;                        ///< standard deviation of the lens's point spread
  double target_brightness = 0.45;              ///< target of exposure control for the mean of the metered rows, 0..1
  double metered_from = 0.0, metered_to = 1.0;  ///< metered rows, as fractions of the height, to exclude the sky
  double start_gain = 1.0;                      ///< of the first frame
  double exposure_lag = 0.15;                   ///< fraction of the correction applied per frame; 0: fixed exposure
  double gamma = 2.2;
};

/// Rain and dirt on the lens.
struct LensEffects {
  double rain = 0.0;   ///< 0..1: streaks of falling drops
  double smear = 0.0;  ///< 0..1: smudges that blur and veil fixed parts of the image
};

/// A camera's sensor with exposure control: exposes frames one after another.
class Sensor {
 public:
  Sensor(const SensorParameters& parameters, const LensEffects& effects, cv::Size size, std::uint64_t seed);

  /// Converts `radiance` (CV_32FC3 linear RGB, overwritten) to CV_8UC3 RGB or CV_8UC1. `frame` counts from 0 and, with
  /// the seed, determines the noise.
  cv::Mat expose(cv::Mat& radiance, std::uint64_t frame);

  /// The gain of the next frame. Copy it to the other eye of a pair so that both share one exposure.
  double gain() const { return gain_; }
  void set_gain(double gain) { gain_ = gain; }

 private:
  cv::Mat through_lens(cv::Mat& radiance, std::uint64_t frame) const;  // grey or RGB, with rain and blur
  void control_exposure(double brightness);                            // mean of the metered rows, 0..1

  SensorParameters parameters_;
  LensEffects effects_;
  std::uint64_t seed_;
  double gain_;
  cv::Mat vignetting_;  // CV_32FC1
  cv::Mat smear_;       // CV_32FC1, 0..1; empty without smear
};

}  // namespace panvo::simulation
