// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/cyclic_integral_images.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

namespace panvo::vision {
namespace {

constexpr int kMargin = 1;             // wrapped columns on each side: radius of the gradient filter
constexpr float kSobel = 1.0F / 8.0F;  // 3x3 Sobel filter to grey levels per px

/// Four sums side by side: dx, |dx|, dy, |dy|.
using Sums = cv::v_int32x4;

/// Adds one pixel to the running row sums and stores them plus the sums of the row above.
void add_pixel(const Sums& pixel, Sums& so_far, const std::int32_t*& above, std::int32_t*& here) {
  so_far = so_far + pixel;
  cv::v_store(here, cv::v_load(above) + so_far);
  above += 4;
  here += 4;
}

/// One row of the gradients' integral images.
void integrate_gradients(const short* dx, const short* dy, int columns, const std::int32_t* above, std::int32_t* here) {
  Sums so_far = cv::v_setzero_s32();
  int x = 0;
  for (; x + 8 <= columns; x += 8) {
    const cv::v_int16x8 u = cv::v_load(dx + x), v = cv::v_load(dy + x);
    const cv::v_int16x8 zero = cv::v_setzero_s16();
    cv::v_int16x8 u_low, u_high, v_low, v_high;  // (dx, |dx|) and (dy, |dy|), pixel by pixel
    cv::v_zip(u, cv::v_max(u, zero - u), u_low, u_high);
    cv::v_zip(v, cv::v_max(v, zero - v), v_low, v_high);
    const std::array halves{std::pair(u_low, v_low), std::pair(u_high, v_high)};
    for (const auto& [us, vs] : halves) {
      Sums first, second;  // still 16 bits each: (dx, |dx|, dy, |dy|) of two pixels
      cv::v_zip(cv::v_reinterpret_as_s32(us), cv::v_reinterpret_as_s32(vs), first, second);
      for (const Sums& pixels : {first, second}) {
        Sums left, right;
        cv::v_expand(cv::v_reinterpret_as_s16(pixels), left, right);
        add_pixel(left, so_far, above, here);
        add_pixel(right, so_far, above, here);
      }
    }
  }
  for (; x < columns; ++x) {
    const int u = dx[x], v = dy[x];
    add_pixel(Sums(u, std::abs(u), v, std::abs(v)), so_far, above, here);
  }
}

}  // namespace

CyclicIntegralImages::CyclicIntegralImages(const cv::Mat& band, int widest) {
  if (band.type() != CV_8UC1 || band.rows < 3 || band.cols < 3) {
    throw std::invalid_argument("integral images need a grey band of at least 3x3 px");
  }
  columns_ = band.cols;
  rows_ = band.rows;
  const int beyond = widest > 0 ? std::min(widest, columns_) : columns_;
  stride_ = static_cast<std::ptrdiff_t>(columns_) + beyond + 1;

  cv::Mat round, dx, dy;
  cv::copyMakeBorder(band, round, 0, 0, kMargin, kMargin, cv::BORDER_WRAP | cv::BORDER_ISOLATED);
  cv::Sobel(round, dx, CV_16S, 1, 0, 3, 1.0, 0.0, cv::BORDER_REPLICATE);
  cv::Sobel(round, dy, CV_16S, 0, 1, 3, 1.0, 0.0, cv::BORDER_REPLICATE);

  const auto cells = static_cast<std::size_t>(stride_ * (rows_ + 1));
  intensity_.resize(cells);
  gradients_.resize(4 * cells);  // only the first row and column are cleared, below
  std::fill_n(intensity_.begin(), stride_, 0);
  std::fill_n(gradients_.begin(), 4 * stride_, 0);
  for (int y = 0; y < rows_; ++y) {
    const uchar* grey = band.ptr<uchar>(y);
    const std::int32_t* above = &intensity_[static_cast<std::size_t>(at(0, y))];
    std::int32_t* here = &intensity_[static_cast<std::size_t>(at(0, y + 1))];
    std::int32_t* gradients = &gradients_[static_cast<std::size_t>(4 * at(0, y + 1))];
    std::int32_t sum = 0;
    here[0] = 0;
    for (int x = 0; x < columns_; ++x) {
      sum += grey[x];
      here[x + 1] = above[x + 1] + sum;
    }
    std::fill_n(gradients, 4, 0);
    integrate_gradients(dx.ptr<short>(y) + kMargin, dy.ptr<short>(y) + kMargin, columns_,
                        &gradients_[static_cast<std::size_t>(4 * at(1, y))], gradients + 4);
    // Beyond the seam: sums from the start of the row plus those of the full turn.
    const std::int32_t turn = here[columns_];
    for (int x = 1; x <= beyond; ++x) here[columns_ + x] = here[x] + turn;
    const Sums gradients_turn = cv::v_load(gradients + 4 * columns_);
    for (int x = 1; x <= beyond; ++x) {
      cv::v_store(gradients + 4 * (columns_ + x), cv::v_load(gradients + 4 * x) + gradients_turn);
    }
  }
}

float CyclicIntegralImages::mean_intensity(const BandRectangle& r) const {
  const std::int32_t* top = &intensity_[static_cast<std::size_t>(at(r.x, r.y))];
  const std::int32_t* bottom = top + r.height * stride_;
  const std::int32_t sum = bottom[r.width] - bottom[0] - top[r.width] + top[0];
  return static_cast<float>(sum) / static_cast<float>(r.width * r.height);
}

GradientStatistics CyclicIntegralImages::mean_gradients(const BandRectangle& r) const {
  const std::int32_t* top = &gradients_[static_cast<std::size_t>(4 * at(r.x, r.y))];
  const std::int32_t* bottom = top + 4 * r.height * stride_;
  const std::ptrdiff_t right = 4 * static_cast<std::ptrdiff_t>(r.width);
  const cv::v_int32x4 sum = cv::v_load(bottom + right) - cv::v_load(bottom) - cv::v_load(top + right) + cv::v_load(top);
  GradientStatistics means{};
  cv::v_store(means.data(), cv::v_cvt_f32(sum) * cv::v_setall_f32(kSobel / static_cast<float>(r.width * r.height)));
  return means;
}

}  // namespace panvo::vision
