// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/compressive_features.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace panvo::vision {
namespace {

constexpr float kSmallestIntensityScale = 4.0F;  // grey levels: an even view must not be blown up to its noise
constexpr float kSmallestGradientScale = 0.5F;   // grey levels per px

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

BandNormalisation BandNormalisation::of(const cv::Mat& band, const CyclicIntegralImages& images) {
  std::array<int, 256> counts{};
  for (int y = 0; y < band.rows; ++y) {
    const uchar* grey = band.ptr<uchar>(y);
    for (int x = 0; x < band.cols; ++x) ++counts[grey[x]];
  }
  double sum = 0.0, square = 0.0, count = 0.0;
  for (int grey = 0; grey < 256; ++grey) {
    const double n = counts[static_cast<std::size_t>(grey)];
    count += n;
    sum += n * grey;
    square += n * grey * grey;
  }
  const double mean = sum / count;
  const GradientStatistics gradients = images.mean_gradients({0, 0, images.columns(), images.rows()});
  BandNormalisation normalisation;
  normalisation.offset = static_cast<float>(mean);
  normalisation.intensity_scale =
      std::max(kSmallestIntensityScale, static_cast<float>(std::sqrt(std::max(0.0, square / count - mean * mean))));
  normalisation.gradient_scale = std::max(kSmallestGradientScale, 0.5F * (gradients[1] + gradients[3]));
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
