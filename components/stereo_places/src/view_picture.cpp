// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/view_picture.hpp"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "panvo/vision/equirectangular.hpp"

namespace panvo::stereo_places {
namespace {

constexpr vision::Equirectangular kSphere{540, 270};
constexpr int kBins = 64;
constexpr int kReduced = 2;  // the picture has fewer pixels than the view

}  // namespace

ViewPicture::ViewPicture(const vision::PinholeCamera& camera)
    : columns_(kSphere.rows, kSphere.columns, CV_32FC1, cv::Scalar(-1e4)), rows_(columns_.clone()) {
  for (int v = 0; v < kSphere.rows; ++v) {
    for (int u = 0; u < kSphere.columns; ++u) {
      const Eigen::Vector3d ray = kSphere.unproject({u, v});
      if (ray.z() < 1e-3) continue;
      const Eigen::Vector2d pixel = camera.project(ray) / kReduced;
      columns_.at<float>(v, u) = static_cast<float>(pixel.x());
      rows_.at<float>(v, u) = static_cast<float>(pixel.y());
    }
  }
}

std::vector<std::uint8_t> ViewPicture::draw(const cv::Mat& left) const {
  cv::Mat reduced, picture;
  cv::resize(left, reduced, left.size() / kReduced, 0.0, 0.0, cv::INTER_AREA);
  cv::remap(reduced, picture, columns_, rows_, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", picture, jpeg, {cv::IMWRITE_JPEG_QUALITY, 80});
  return jpeg;
}

std::vector<float> grey_levels(const cv::Mat& left) {
  std::vector<double> counts(kBins, 0.0);
  for (int v = 0; v < left.rows; ++v) {
    const auto* row = left.ptr<uchar>(v);
    for (int u = 0; u < left.cols; ++u) counts[row[u] * kBins / 256] += 1.0;
  }
  std::vector<float> shares;
  for (const double count : counts) shares.push_back(static_cast<float>(count / static_cast<double>(left.total())));
  return shares;
}

}  // namespace panvo::stereo_places
