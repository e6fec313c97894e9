// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/compressive_features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace panvo::vision {
namespace {

constexpr float kSmallestIntensityScale = 4.0F;  // grey levels: an even view must not be blown up to its noise
constexpr float kSmallestGradientScale = 0.5F;   // grey levels per px

constexpr int kSectors = 24;  // of 15 degrees
constexpr double kSmoothing_px = 1.0;
constexpr double kLinearBelow = 16.0;  // grey levels: the scale is linear where noise is more than shade

float median(std::array<float, kSectors> values) {
  std::sort(values.begin(), values.end());
  return 0.5F * (values[kSectors / 2 - 1] + values[kSectors / 2]);
}

/// An element's rectangle, displaced.
BandRectangle displace(BandRectangle r, int du, int dv, int columns, int rows) {
  r.x += du;
  if (r.x >= columns) r.x -= columns;
  r.y = std::clamp(r.y + dv, 0, rows - r.height);
  return r;
}

int wrapped(int du, int columns) {
  const int remainder = du % columns;
  return remainder < 0 ? remainder + columns : remainder;
}

}  // namespace

cv::Mat prepare_band(const cv::Mat& band) {
  constexpr int kMargin = 4;  // px, the reach of the filter
  cv::Mat round, smooth, prepared;
  cv::copyMakeBorder(band, round, 0, 0, kMargin, kMargin, cv::BORDER_WRAP | cv::BORDER_ISOLATED);
  cv::GaussianBlur(round, smooth, cv::Size(5, 5), kSmoothing_px, kSmoothing_px, cv::BORDER_REPLICATE);
  cv::Mat table(1, 256, CV_8UC1);
  for (int grey = 0; grey < 256; ++grey) {
    table.at<uchar>(grey) =
        static_cast<uchar>(std::lround(255.0 * std::log1p(grey / kLinearBelow) / std::log1p(255.0 / kLinearBelow)));
  }
  cv::LUT(smooth.colRange(kMargin, kMargin + band.cols), table, prepared);
  return prepared;
}

BandNormalisation BandNormalisation::of(const cv::Mat& band, const CyclicIntegralImages& images) {
  std::array<float, kSectors> means{}, deviations{}, gradients{};
  for (int i = 0; i < kSectors; ++i) {
    const int begin = i * band.cols / kSectors;
    const int width = std::max(1, (i + 1) * band.cols / kSectors - begin);
    cv::Scalar mean, deviation;
    cv::meanStdDev(band.colRange(begin, begin + width), mean, deviation);
    const GradientStatistics statistics = images.mean_gradients({begin, 0, width, band.rows});
    const auto sector = static_cast<std::size_t>(i);
    means[sector] = static_cast<float>(mean[0]);
    deviations[sector] = static_cast<float>(deviation[0]);
    gradients[sector] = 0.5F * (statistics[1] + statistics[3]);
  }
  BandNormalisation normalisation;
  normalisation.offset = median(means);
  normalisation.intensity_scale = std::max(kSmallestIntensityScale, median(deviations));
  normalisation.gradient_scale = std::max(kSmallestGradientScale, median(gradients));
  return normalisation;
}

float ResponseReader::read_intensity(int row, int du, int dv) const {
  const int shift = wrapped(du, images_.columns());
  float response = 0.0F;
  for (const MeasurementMatrix::Element& element : matrix_.row(row)) {
    const BandRectangle r = displace(element.rectangle, shift, dv, images_.columns(), images_.rows());
    response += element.sign * (images_.mean_intensity(r) - normalisation_.offset);
  }
  return response / normalisation_.intensity_scale;
}

float ResponseReader::read_gradient(int row, int du, int dv) const {
  const int shift = wrapped(du, images_.columns());
  float response = 0.0F;
  for (const MeasurementMatrix::Element& element : matrix_.row(row)) {
    const BandRectangle r = displace(element.rectangle, shift, dv, images_.columns(), images_.rows());
    const GradientStatistics means = images_.mean_gradients(r);
    const std::array<float, 4>& chosen = element.statistics;
    response +=
        element.sign * (chosen[0] * means[0] + chosen[1] * means[1] + chosen[2] * means[2] + chosen[3] * means[3]);
  }
  return response / normalisation_.gradient_scale;
}

CompressiveFeature ResponseReader::read(int row, int du, int dv) const {
  return {read_intensity(row, du, dv), read_gradient(row, du, dv)};
}

}  // namespace panvo::vision
