// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/compressive_features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "lane_sum.hpp"

namespace panvo::vision {
namespace {

constexpr float kMinIntensityScale = 4.0F;  // grey levels: avoids amplifying the noise of a uniform view
constexpr float kMinGradientScale = 0.5F;   // grey levels per px

constexpr float kSobelSum = 8.0F;  // scale of the integer Sobel responses in the integral images
constexpr int kSectors = 24;       // 15 degrees each
constexpr double kSmoothing_px = 1.0;
constexpr double kLinearBelow = 16.0;  // grey levels: linear scale below, where noise dominates

float median_of_sectors(std::array<float, kSectors> values) {
  std::sort(values.begin(), values.end());
  return 0.5F * (values[kSectors / 2 - 1] + values[kSectors / 2]);
}

int wrapped_column(int du, int columns) {
  if (du >= 0 && du < columns) return du;
  const int remainder = du % columns;
  return remainder < 0 ? remainder + columns : remainder;
}

}  // namespace

cv::Mat prepare_band(const cv::Mat& band) {
  constexpr int kMargin = 4;  // px, at least the filter radius
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
  normalisation.offset = median_of_sectors(means);
  normalisation.intensity_scale = std::max(kMinIntensityScale, median_of_sectors(deviations));
  normalisation.gradient_scale = std::max(kMinGradientScale, median_of_sectors(gradients));
  return normalisation;
}

/// Index of a displaced rectangle in the integral images, and offsets to its other corners.
struct ResponseReader::Cell {
  std::ptrdiff_t first, right, down;
};

ResponseReader::ResponseReader(const CyclicIntegralImages& images, const MeasurementMatrix& matrix,
                               const BandNormalisation& normalisation)
    : images_(images),
      matrix_(matrix),
      normalisation_(normalisation),
      per_intensity_(1.0F / normalisation.intensity_scale),
      per_gradient_(1.0F / (kSobelSum * normalisation.gradient_scale)) {
  if (matrix.band() != cv::Size(images.columns(), images.rows()) || matrix.widest() > images.widest()) {
    throw std::invalid_argument("measurement matrix and integral images differ in band size or rectangle width");
  }
}

inline ResponseReader::Cell ResponseReader::displace(const MeasurementMatrix::Element& element, int shift,
                                                     int dv) const {
  const BandRectangle& r = element.rectangle;
  int x = r.x + shift;
  if (x >= images_.columns()) x -= images_.columns();
  const int y = std::clamp(r.y + dv, 0, images_.rows() - r.height);
  return {images_.at(x, y), r.width, r.height * images_.stride_};
}

inline float ResponseReader::intensity_sum(const Cell& cell) const {
  const std::int32_t* sums = images_.intensity_.data() + cell.first;
  return static_cast<float>(sums[cell.right + cell.down] - sums[cell.down] - sums[cell.right] + sums[0]);
}

inline cv::v_float32x4 ResponseReader::gradient_sums(const Cell& cell) const {
  const std::int32_t* sums = images_.gradients_.data() + 4 * cell.first;
  return cv::v_cvt_f32(cv::v_load(sums + 4 * (cell.right + cell.down)) - cv::v_load(sums + 4 * cell.down) -
                       cv::v_load(sums + 4 * cell.right) + cv::v_load(sums));
}

float ResponseReader::read_intensity(int row, int du, int dv) const {
  const int shift = wrapped_column(du, images_.columns());
  float response = 0.0F;
  for (const MeasurementMatrix::Element& element : matrix_.row(row)) {
    const float mean = intensity_sum(displace(element, shift, dv)) * element.share;
    response += element.sign * (mean - normalisation_.offset);
  }
  return response * per_intensity_;
}

float ResponseReader::read_gradient(int row, int du, int dv) const {
  const int shift = wrapped_column(du, images_.columns());
  cv::v_float32x4 response = cv::v_setzero_f32();
  for (const MeasurementMatrix::Element& element : matrix_.row(row)) {
    const cv::v_float32x4 sums = gradient_sums(displace(element, shift, dv));
    response =
        response + sums * (cv::v_load(element.statistics.data()) * cv::v_setall_f32(element.sign * element.share));
  }
  return lane_sum(response) * per_gradient_;
}

CompressiveFeature ResponseReader::read(int row, int du, int dv) const {
  const int shift = wrapped_column(du, images_.columns());
  float intensity = 0.0F;
  cv::v_float32x4 gradient = cv::v_setzero_f32();
  for (const MeasurementMatrix::Element& element : matrix_.row(row)) {
    const Cell cell = displace(element, shift, dv);
    intensity += element.sign * (intensity_sum(cell) * element.share - normalisation_.offset);
    gradient = gradient + gradient_sums(cell) *
                              (cv::v_load(element.statistics.data()) * cv::v_setall_f32(element.sign * element.share));
  }
  return {intensity * per_intensity_, lane_sum(gradient) * per_gradient_};
}

}  // namespace panvo::vision
