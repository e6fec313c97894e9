// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/rectification.hpp"

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>

#include "panvo/vision/camera_model.hpp"
#include "panvo/vision/packed_lookup.hpp"

namespace panvo::vision {

RectificationMap::RectificationMap(const LensCamera& raw, const Eigen::Matrix3d& rectified_from_raw,
                                   const PinholeCamera& rectified)
    : raw_size_(raw.pinhole.width, raw.pinhole.height) {
  if (raw.model == LensModel::kPlumbBob) {  // a faster way to the same map; every other lens takes the general one
    map_perspective(raw, rectified_from_raw, rectified);
  } else {
    map_wide(raw, rectified_from_raw, rectified);
  }
  pack();
}

void RectificationMap::map_perspective(const LensCamera& raw, const Eigen::Matrix3d& rectified_from_raw,
                                       const PinholeCamera& rectified) {
  const auto matrix = [](const PinholeCamera& camera) {
    return cv::Matx33d(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  };
  const auto& r = rectified_from_raw;
  const cv::Matx33d rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2));
  const cv::Matx<double, 1, 5> distortion(raw.distortion.data());
  cv::initUndistortRectifyMap(matrix(raw.pinhole), distortion, rotation, matrix(rectified),
                              {rectified.width, rectified.height}, CV_16SC2, coordinates_, fractions_);
}

void RectificationMap::map_wide(const LensCamera& raw, const Eigen::Matrix3d& rectified_from_raw,
                                const PinholeCamera& rectified) {
  const CameraModel model(raw);
  cv::Mat places(rectified.height, rectified.width, CV_32FC2);
  cv::Mat unseen(rectified.height, rectified.width, CV_8UC1, cv::Scalar(0));
  const cv::Rect2d image(-0.5, -0.5, raw_size_.width, raw_size_.height);
  for (int v = 0; v < rectified.height; ++v) {
    for (int u = 0; u < rectified.width; ++u) {
      const auto pixel = model.project(rectified_from_raw.transpose() * rectified.unproject({u, v}));
      const bool is_seen = pixel && image.contains({pixel->x(), pixel->y()});
      places.at<cv::Vec2f>(v, u) =
          is_seen ? cv::Vec2f(static_cast<float>(pixel->x()), static_cast<float>(pixel->y())) : cv::Vec2f(0.0F, 0.0F);
      if (!is_seen) unseen.at<uchar>(v, u) = 255;
    }
  }
  if (cv::countNonZero(unseen) > 0) unseen_ = unseen;
  cv::convertMaps(places, cv::noArray(), coordinates_, fractions_, CV_16SC2);
}

void RectificationMap::pack() {
  if (raw_size_.area() > static_cast<int>(kMaxLookupOffset)) return;
  lookups_.reserve(coordinates_.total());
  for (int v = 0; v < coordinates_.rows; ++v) {
    for (int u = 0; u < coordinates_.cols; ++u) {
      const auto at = coordinates_.at<cv::Vec2s>(v, u);
      const std::uint32_t fraction = fractions_.at<std::uint16_t>(v, u);
      const bool is_inside = may_be_looked_up(at[0], at[1], raw_size_.width, raw_size_.height);
      const auto offset = static_cast<std::uint32_t>(is_inside ? at[1] * raw_size_.width + at[0] : 0);
      lookups_.push_back(pack_lookup(offset, fraction % kLookupFraction, fraction / kLookupFraction));
      if (!is_inside) patches_.emplace_back(u, v);
    }
  }
}

void RectificationMap::apply(const cv::Mat& raw_image, cv::Mat& destination) const {
  if (raw_image.size() != raw_size_) {
    std::ostringstream text;
    text << "image of " << raw_image.cols << " x " << raw_image.rows << " px given to a rectification map of a "
         << raw_size_.width << " x " << raw_size_.height << " px camera";
    throw std::invalid_argument(text.str());
  }
  const bool is_packed = !lookups_.empty() && (raw_image.type() == CV_8UC1 || raw_image.type() == CV_8UC3) &&
                         may_be_looked_up(0, 0, raw_size_.width, raw_size_.height);
  if (is_packed) {
    look_up_rows(raw_image, destination);
  } else {
    cv::remap(raw_image, destination, coordinates_, fractions_, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  }
  if (!unseen_.empty()) destination.setTo(cv::Scalar::all(0), unseen_);
}

void RectificationMap::look_up_rows(const cv::Mat& raw_image, cv::Mat& destination) const {
  const bool is_itself = destination.data == raw_image.data;
  const cv::Mat raw = raw_image.isContinuous() && !is_itself ? raw_image : raw_image.clone();
  destination.create(coordinates_.size(), raw.type());
  const LookupSource source{raw.data, raw.cols, kUnitFactor};
  for (int row = 0; row < destination.rows; ++row) {
    const auto* lookups = lookups_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(destination.cols);
    look_up(source, lookups, destination.cols, raw.channels(), destination.ptr(row));
  }
  patch(raw, destination);
}

/// Fills the pixels with neighbours outside the raw image by replicating its border.
void RectificationMap::patch(const cv::Mat& raw_image, cv::Mat& destination) const {
  const int channels = raw_image.channels();
  for (const auto& pixel : patches_) {
    const auto at = coordinates_.at<cv::Vec2s>(pixel);
    const int fraction = fractions_.at<std::uint16_t>(pixel);
    const int x = fraction % kLookupFraction;
    const int y = fraction / kLookupFraction;
    const int left = std::clamp<int>(at[0], 0, raw_image.cols - 1),
              right = std::clamp(at[0] + 1, 0, raw_image.cols - 1);
    const uchar* upper = raw_image.ptr(std::clamp<int>(at[1], 0, raw_image.rows - 1));
    const uchar* lower = raw_image.ptr(std::clamp(at[1] + 1, 0, raw_image.rows - 1));
    uchar* to = destination.ptr(pixel.y) + pixel.x * channels;
    for (int channel = 0; channel < channels; ++channel) {
      const auto across = [&](const uchar* row) {
        return row[left * channels + channel] * (kLookupFraction - x) + row[right * channels + channel] * x;
      };
      to[channel] = static_cast<uchar>((across(upper) * (kLookupFraction - y) + across(lower) * y + 512) >> 10);
    }
  }
}

}  // namespace panvo::vision
