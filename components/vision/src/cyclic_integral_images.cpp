// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/cyclic_integral_images.hpp"

#include <algorithm>
#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace panvo::vision {
namespace {

constexpr int kMargin = 1;             // columns of the other end beside the band: the reach of the gradient filter
constexpr float kSobel = 1.0F / 8.0F;  // Sobel's 3x3 filter to grey levels per px

}  // namespace

CyclicIntegralImages::CyclicIntegralImages(const cv::Mat& band) {
  if (band.type() != CV_8UC1 || band.rows < 3 || band.cols < 3) {
    throw std::invalid_argument("integral images need a grey band of at least 3x3 px");
  }
  columns_ = band.cols;
  rows_ = band.rows;
  stride_ = 2 * static_cast<std::ptrdiff_t>(columns_) + 1;

  cv::Mat round, dx, dy;
  cv::copyMakeBorder(band.clone(), round, 0, 0, kMargin, kMargin, cv::BORDER_WRAP);
  cv::Sobel(round, dx, CV_16S, 1, 0, 3, 1.0, 0.0, cv::BORDER_REPLICATE);
  cv::Sobel(round, dy, CV_16S, 0, 1, 3, 1.0, 0.0, cv::BORDER_REPLICATE);

  const auto cells = static_cast<std::size_t>(stride_ * (rows_ + 1));
  intensity_.assign(cells, 0);
  gradients_.assign(4 * cells, 0);
  for (int y = 0; y < rows_; ++y) {
    const uchar* grey = band.ptr<uchar>(y);
    const short* along_u = dx.ptr<short>(y) + kMargin;
    const short* along_v = dy.ptr<short>(y) + kMargin;
    const std::int32_t* above = &intensity_[static_cast<std::size_t>(at(0, y))];
    std::int32_t* here = &intensity_[static_cast<std::size_t>(at(0, y + 1))];
    const std::int32_t* gradients_above = &gradients_[static_cast<std::size_t>(4 * at(0, y))];
    std::int32_t* gradients_here = &gradients_[static_cast<std::size_t>(4 * at(0, y + 1))];
    std::int32_t sum = 0;
    cv::v_int32x4 sums = cv::v_setzero_s32();
    for (int x = 0; x < columns_; ++x) {
      sum += grey[x];
      here[x + 1] = above[x + 1] + sum;
      const int u = along_u[x], v = along_v[x];
      sums = sums + cv::v_int32x4(u, u < 0 ? -u : u, v, v < 0 ? -v : v);
      cv::v_store(gradients_here + 4 * (x + 1), cv::v_load(gradients_above + 4 * (x + 1)) + sums);
    }
    // The second period: what the first one has, and its whole row.
    const std::int32_t turn = here[columns_];
    const cv::v_int32x4 gradients_turn = cv::v_load(gradients_here + 4 * columns_);
    for (int x = 1; x <= columns_; ++x) {
      here[columns_ + x] = here[x] + turn;
      cv::v_store(gradients_here + 4 * (columns_ + x), cv::v_load(gradients_here + 4 * x) + gradients_turn);
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
