// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/grey.hpp"

#include <gtest/gtest.h>

namespace panvo::vision {
namespace {

TEST(Grey, OfColourIsWeightedAsTheEyeDoes) {
  const cv::Mat bgr(2, 3, CV_8UC3, cv::Scalar(255, 0, 100));
  const cv::Mat grey = to_grey(bgr);
  ASSERT_EQ(grey.type(), CV_8UC1);
  ASSERT_EQ(grey.size(), bgr.size());
  EXPECT_EQ(grey.at<std::uint8_t>(1, 2), 59);  // 0.114 * 255 + 0.299 * 100
  EXPECT_NE(grey.data, bgr.data);
}

TEST(Grey, OfAGreyImageSharesItsPixels) {
  const cv::Mat image(2, 3, CV_8UC1, cv::Scalar(7));
  EXPECT_EQ(to_grey(image).data, image.data);
}

}  // namespace
}  // namespace panvo::vision
