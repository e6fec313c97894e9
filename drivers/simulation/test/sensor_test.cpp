// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core/utility.hpp>
#include <stdexcept>

namespace panvo::simulation {
namespace {

constexpr int kWidth = 320, kHeight = 240;

cv::Mat even(double radiance) { return cv::Mat(kHeight, kWidth, CV_32FC3, cv::Scalar::all(radiance)); }

SensorParameters plain() {
  SensorParameters parameters;
  parameters.vignetting = 0.0;
  parameters.blur_px = 0.0;
  parameters.exposure_lag = 0.0;
  parameters.gamma = 1.0;
  parameters.full_well = 2000.0;
  return parameters;
}

TEST(Sensor, HasTheNoiseOfItsElectrons) {
  for (const bool colour : {false, true}) {
    auto parameters = plain();
    parameters.colour = colour;
    parameters.read_noise = 20.0;
    Sensor sensor(parameters, {}, {kWidth, kHeight}, 5);
    for (const double light : {0.1, 0.5}) {
      cv::Mat radiance = even(light);
      const cv::Mat image = sensor.expose(radiance, 3);
      ASSERT_EQ(image.type(), colour ? CV_8UC3 : CV_8UC1);
      cv::Scalar mean, deviation;
      cv::meanStdDev(image, mean, deviation);
      const double electrons = light * parameters.full_well;
      const double rounding = 1.0 / 12.0;
      const double expected = std::sqrt((electrons + 400.0) * std::pow(255.0 / parameters.full_well, 2.0) + rounding);
      EXPECT_NEAR(mean[0], 255.0 * light, 0.3);
      EXPECT_NEAR(deviation[0], expected, 0.02 * expected);
    }
  }
}

TEST(Sensor, HasOtherNoiseInEachFrameAndTheSameForTheSameSeed) {
  Sensor sensor(plain(), {}, {kWidth, kHeight}, 5);
  Sensor again(plain(), {}, {kWidth, kHeight}, 5);
  Sensor other(plain(), {}, {kWidth, kHeight}, 6);
  const auto expose = [](Sensor& with, std::uint64_t frame) {
    cv::Mat radiance = even(0.4);
    return with.expose(radiance, frame);
  };
  const auto differing = [](const cv::Mat& a, const cv::Mat& b) {
    return cv::countNonZero(a.reshape(1) != b.reshape(1)) / static_cast<double>(a.total() * 3);
  };
  const cv::Mat first = expose(sensor, 0);
  EXPECT_EQ(differing(first, expose(again, 0)), 0.0);
  EXPECT_GT(differing(first, expose(sensor, 1)), 0.8);
  EXPECT_GT(differing(first, expose(other, 0)), 0.8);
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const cv::Mat alone = expose(again, 0);
  cv::setNumThreads(threads);
  EXPECT_EQ(differing(first, alone), 0.0);
}

TEST(Sensor, ComesToTheBrightnessItAimsAt) {
  SensorParameters parameters;
  parameters.target_brightness = 0.42;
  Sensor sensor(parameters, {}, {kWidth, kHeight}, 5);
  for (const double light : {0.03, 0.6}) {
    cv::Mat image;
    for (std::uint64_t frame = 0; frame < 60; ++frame) {
      cv::Mat radiance = even(light);
      image = sensor.expose(radiance, frame);
    }
    EXPECT_NEAR(cv::mean(image)[1] / 255.0, 0.42, 0.01);
  }
}

TEST(Sensor, KeepsItsGainWhereNothingAdapts) {
  Sensor sensor(plain(), {}, {kWidth, kHeight}, 5);
  sensor.set_gain(2.0);
  cv::Mat radiance = even(0.2);
  const cv::Mat image = sensor.expose(radiance, 0);
  EXPECT_NEAR(cv::mean(image)[0], 0.4 * 255.0, 0.5);
  EXPECT_EQ(sensor.gain(), 2.0);
}

TEST(Sensor, LosesLightInTheCorners) {
  auto parameters = plain();
  parameters.vignetting = 0.4;
  parameters.full_well = 1e6;
  Sensor sensor(parameters, {}, {kWidth, kHeight}, 5);
  cv::Mat radiance = even(0.5);
  const cv::Mat image = sensor.expose(radiance, 0);
  EXPECT_NEAR(image.at<cv::Vec3b>(0, 0)[0], 255 * 0.5 * 0.6, 3);
  EXPECT_NEAR(image.at<cv::Vec3b>(kHeight / 2, kWidth / 2)[0], 255 * 0.5, 3);
}

TEST(Sensor, BlursAsMuchAsTold) {
  auto parameters = plain();
  parameters.blur_px = 0.8;
  parameters.full_well = 1e9;
  parameters.read_noise = 0.0;
  parameters.colour = false;
  Sensor sensor(parameters, {}, {kWidth, kHeight}, 5);
  cv::Mat radiance = even(0.0);
  radiance.at<cv::Vec3f>(100, 150) = cv::Vec3f::all(5.0f);
  const cv::Mat image = sensor.expose(radiance, 0);
  double sum = 0.0, square = 0.0, column = 0.0;
  for (int row = 90; row < 110; ++row) {
    for (int x = 140; x < 160; ++x) {
      const double value = image.at<std::uint8_t>(row, x);
      sum += value;
      column += value * x;
      square += value * (x - 150.0) * (x - 150.0);
    }
  }
  EXPECT_NEAR(column / sum, 150.0, 0.01);
  EXPECT_NEAR(std::sqrt(square / sum), 0.8, 0.05);
}

TEST(Sensor, SeesRainThatMovesAndSmearThatStays) {
  auto parameters = plain();
  parameters.full_well = 1e8;
  parameters.read_noise = 0.0;
  const auto expose = [&](const LensEffects& effects, std::uint64_t frame) {
    Sensor sensor(parameters, effects, {kWidth, kHeight}, 5);
    cv::Mat radiance = even(0.2);
    radiance.rowRange(0, kHeight / 2).setTo(cv::Scalar::all(0.6));
    return sensor.expose(radiance, frame);
  };
  const auto differing = [](const cv::Mat& a, const cv::Mat& b) {
    return cv::countNonZero(cv::Mat(cv::abs(a - b)).reshape(1) > 2);
  };
  const cv::Mat clear = expose({}, 0);
  EXPECT_GT(differing(clear, expose({1.0, 0.0}, 0)), 500);
  EXPECT_GT(differing(expose({1.0, 0.0}, 0), expose({1.0, 0.0}, 1)), 500);
  EXPECT_GT(differing(clear, expose({0.0, 1.0}, 0)), 100);
  EXPECT_EQ(differing(expose({0.0, 1.0}, 0), expose({0.0, 1.0}, 1)), 0);
}

TEST(Sensor, RefusesWhatNoSensorIs) {
  auto parameters = plain();
  parameters.full_well = 0.0;
  EXPECT_THROW(Sensor(parameters, {}, {kWidth, kHeight}, 5), std::invalid_argument);
  EXPECT_THROW(Sensor(plain(), {}, {0, kHeight}, 5), std::invalid_argument);
  Sensor sensor(plain(), {}, {kWidth, kHeight}, 5);
  cv::Mat other_size(10, 10, CV_32FC3);
  EXPECT_THROW(sensor.expose(other_size, 0), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::simulation
