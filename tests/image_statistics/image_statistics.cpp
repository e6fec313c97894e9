// SPDX-License-Identifier: Apache-2.0
#include "image_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace panvo::testing {
namespace {

double quantile(std::vector<float> values, double share) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

std::vector<float> gradient_magnitudes(const cv::Mat& image) {
  cv::Mat dx, dy, magnitude;
  cv::Sobel(image, dx, CV_32F, 1, 0, 3, 0.125);
  cv::Sobel(image, dy, CV_32F, 0, 1, 3, 0.125);
  cv::magnitude(dx, dy, magnitude);
  return {magnitude.begin<float>(), magnitude.end<float>()};
}

/// Least-squares slope of log power over log frequency, with power averaged over directions in rings of a third octave.
double spectrum_slope(const cv::Mat& image) {
  constexpr int kSide = 256;
  double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0, rings = 0;
  cv::Mat window;
  cv::createHanningWindow(window, {kSide, kSide}, CV_32F);
  cv::Mat power = cv::Mat::zeros(kSide, kSide, CV_32F);
  for (int y = 0; y + kSide <= image.rows; y += kSide / 2) {
    for (int x = 0; x + kSide <= image.cols; x += kSide / 2) {
      cv::Mat patch = image(cv::Rect(x, y, kSide, kSide)).clone();
      patch -= cv::mean(patch)[0];
      patch = patch.mul(window);
      cv::Mat spectrum;
      cv::dft(patch, spectrum, cv::DFT_COMPLEX_OUTPUT);
      std::vector<cv::Mat> parts;
      cv::split(spectrum, parts);
      power += parts[0].mul(parts[0]) + parts[1].mul(parts[1]);
    }
  }
  for (double low = 1.0 / 64.0; low < 1.0 / 3.0; low *= std::cbrt(2.0)) {
    double ring_power = 0;
    int count = 0;
    for (int v = 0; v < kSide; ++v) {
      for (int u = 0; u < kSide; ++u) {
        const double fu = (u > kSide / 2 ? u - kSide : u) / static_cast<double>(kSide);
        const double fv = (v > kSide / 2 ? v - kSide : v) / static_cast<double>(kSide);
        const double frequency = std::hypot(fu, fv);
        if (frequency < low || frequency >= low * std::cbrt(2.0)) continue;
        ring_power += power.at<float>(v, u);
        ++count;
      }
    }
    if (count == 0 || ring_power <= 0) continue;
    const double x = std::log(low), y = std::log(ring_power / count);
    sum_x += x, sum_y += y, sum_xx += x * x, sum_xy += x * y, rings += 1;
  }
  return (rings * sum_xy - sum_x * sum_y) / (rings * sum_xx - sum_x * sum_x);
}

std::array<double, 5> octave_contrasts(const cv::Mat& image) {
  std::array<double, 5> contrasts{};
  cv::Mat level = image;
  for (auto& contrast : contrasts) {
    cv::Mat smaller, back;
    cv::pyrDown(level, smaller);
    cv::pyrUp(smaller, back, level.size());
    contrast = std::sqrt(cv::mean((level - back).mul(level - back))[0]);
    level = smaller;
  }
  return contrasts;
}

}  // namespace

ImageStatistics measure(const cv::Mat& grey) {
  ImageStatistics statistics;
  const double megapixels = 1e-6 * static_cast<double>(grey.total());
  std::vector<cv::KeyPoint> corners;
  cv::FAST(grey, corners, 20);
  statistics.fast_per_megapixel = static_cast<double>(corners.size()) / megapixels;
  cv::SIFT::create()->detect(grey, corners);
  statistics.sift_per_megapixel = static_cast<double>(corners.size()) / megapixels;
  cv::Mat image;
  grey.convertTo(image, CV_32F);
  const auto gradients = gradient_magnitudes(image);
  statistics.gradient_median = quantile(gradients, 0.5);
  statistics.gradient_90 = quantile(gradients, 0.9);
  statistics.spectrum_slope = spectrum_slope(image);
  statistics.octaves = octave_contrasts(image);
  return statistics;
}

double survival(const cv::Mat& first, const cv::Mat& second) {
  const auto sift = cv::SIFT::create(1500);
  std::vector<cv::KeyPoint> there, here;
  cv::Mat descriptors_there, descriptors_here;
  sift->detectAndCompute(first, {}, there, descriptors_there);
  sift->detectAndCompute(second, {}, here, descriptors_here);
  constexpr std::size_t kMin = 16;
  if (there.size() < kMin || here.size() < kMin) return 0.0;
  std::vector<std::vector<cv::DMatch>> forward, backward;
  const cv::BFMatcher matcher(cv::NORM_L2);
  matcher.knnMatch(descriptors_there, descriptors_here, forward, 2);
  matcher.knnMatch(descriptors_here, descriptors_there, backward, 1);
  std::vector<cv::Point2f> from, to;
  for (const auto& match : forward) {
    if (match[0].distance > 0.8f * match[1].distance) continue;
    if (backward[static_cast<std::size_t>(match[0].trainIdx)][0].trainIdx != match[0].queryIdx) continue;
    from.push_back(there[static_cast<std::size_t>(match[0].queryIdx)].pt);
    to.push_back(here[static_cast<std::size_t>(match[0].trainIdx)].pt);
  }
  if (from.size() < kMin) return 0.0;
  cv::Mat inliers;
  cv::setRNGSeed(1);
  cv::findFundamentalMat(from, to, cv::FM_RANSAC, 1.5, 0.999, inliers);
  return static_cast<double>(cv::countNonZero(inliers)) / static_cast<double>(there.size());
}

}  // namespace panvo::testing
