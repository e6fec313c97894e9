// SPDX-License-Identifier: Apache-2.0
#include "numbered_pictures.hpp"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "panvo/conversions/image.hpp"
#include "sensor_msgs/msg/Image.h"

namespace panvo::test {
namespace {

constexpr int kStripes = 6;
static_assert(NumberedPictures::kCount == 1U << kStripes);
const cv::Scalar kBlack(16, 16, 16), kWhite(240, 240, 240);

/// Region of a stripe in the image of one eye; -1: region above the stripes.
cv::Rect place(cv::Size eye, int stripe) {
  const int half = eye.height / 2;
  if (stripe < 0) return {0, 0, eye.width, half};
  const int width = eye.width / kStripes;
  return {stripe * width, half, width, eye.height - half};
}

}  // namespace

NumberedPictures::NumberedPictures(int width, int height) {
  for (std::uint32_t number = 0; number < kCount; ++number) {
    cv::Mat whole(height, width, CV_8UC3, kBlack);
    for (const bool is_right : {false, true}) {
      cv::Mat eye = whole.colRange(is_right ? width / 2 : 0, is_right ? width : width / 2);
      for (int stripe = -1; stripe < kStripes; ++stripe) {
        const bool is_white = stripe < 0 ? is_right : ((number >> stripe) & 1U) != 0;
        eye(place(eye.size(), stripe)).setTo(is_white ? kWhite : kBlack);
      }
    }
    cv::imencode(".jpg", whole, files_.emplace_back(), {cv::IMWRITE_JPEG_QUALITY, 90});
  }
}

std::optional<NumberedPicture> read_number(const sensor_msgs::msg::Image& eye) {
  const auto pixels = conversions::grey(eye);
  if (!pixels) return std::nullopt;
  NumberedPicture result;
  for (int stripe = -1; stripe < kStripes; ++stripe) {
    cv::Scalar mean, deviation;
    const cv::Rect whole = place(pixels->size(), stripe);
    constexpr int kEdge = 4;  // JPEG blocks blur across edges
    cv::meanStdDev(
        (*pixels)(cv::Rect(whole.x + kEdge, whole.y + kEdge, whole.width - 2 * kEdge, whole.height - 2 * kEdge)), mean,
        deviation);
    constexpr double kMiddle = 128.0, kEven = 20.0;
    if (deviation[0] > kEven) return std::nullopt;
    if (mean[0] < kMiddle) continue;
    if (stripe < 0) {
      result.is_right = true;
    } else {
      result.number |= 1U << stripe;
    }
  }
  return result;
}

}  // namespace panvo::test
