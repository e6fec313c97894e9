// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/grey.hpp"

#include <opencv2/imgproc.hpp>

namespace panvo::vision {

cv::Mat to_grey(const cv::Mat& image) {
  if (image.channels() == 1) return image;
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace panvo::vision
