// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/image_pyramid.hpp"

#include <opencv2/imgproc.hpp>

namespace panvo::vision {
namespace {
constexpr int kMinSide = 32;
}

ImagePyramid::ImagePyramid(const cv::Mat& image, int levels) {
  CV_Assert(image.type() == CV_8UC1 && !image.empty());
  images_.resize(1);
  cv::GaussianBlur(image, images_[0], {3, 3}, 0.0, 0.0, cv::BORDER_REPLICATE);
  while (this->levels() < levels && std::min(images_.back().cols, images_.back().rows) >= 2 * kMinSide) {
    cv::Mat half;
    cv::pyrDown(images_.back(), half);
    images_.push_back(half);
  }
}

}  // namespace panvo::vision
