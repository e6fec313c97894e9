// SPDX-License-Identifier: Apache-2.0
#include "coarse_turn.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "panvo/vision/pose.hpp"

namespace panvo::binocular_odometry {
namespace {

constexpr int kWidth_px = 40;
constexpr double kMaxShift = 0.4;  // of the image size: beyond, the overlap is too small

cv::Mat tiny(const vision::ImagePyramid& image) {
  const cv::Mat& coarsest = image[image.levels() - 1];
  const int height = std::max(8, static_cast<int>(std::lround(1.0 * kWidth_px * coarsest.rows / coarsest.cols)));
  cv::Mat small;
  cv::resize(coarsest, small, {kWidth_px, height}, 0.0, 0.0, cv::INTER_AREA);
  small.convertTo(small, CV_32F);
  return small;
}

// Zero-mean normalised correlation over the overlap of `current` and `previous` shifted by `shift`.
double correlation(const cv::Mat& previous, const cv::Mat& current, cv::Point shift) {
  const cv::Rect frame({}, previous.size());
  const cv::Rect in_current = frame & (frame + shift);
  const cv::Mat a = previous(in_current - shift), b = current(in_current);
  cv::Scalar mean_a, mean_b, deviation_a, deviation_b;
  cv::meanStdDev(a, mean_a, deviation_a);
  cv::meanStdDev(b, mean_b, deviation_b);
  const double covariance = a.dot(b) / static_cast<double>(a.total()) - mean_a[0] * mean_b[0];
  return covariance / std::max(deviation_a[0] * deviation_b[0], 1e-6);
}

}  // namespace

Eigen::Matrix3d coarse_turn(const vision::PinholeCamera& camera, const vision::ImagePyramid& previous,
                            const vision::ImagePyramid& current) {
  const cv::Mat before = tiny(previous), now = tiny(current);
  const int reach_u = static_cast<int>(kMaxShift * before.cols), reach_v = static_cast<int>(kMaxShift * before.rows);
  cv::Point best(0, 0);
  double highest = -1.0;
  for (int v = -reach_v; v <= reach_v; ++v) {
    for (int u = -reach_u; u <= reach_u; ++u) {
      const double here = correlation(before, now, {u, v});
      if (here <= highest) continue;
      highest = here;
      best = {u, v};
    }
  }
  const double scale_u = static_cast<double>(camera.width) / before.cols;
  const double scale_v = static_cast<double>(camera.height) / before.rows;
  return vision::so3_exp({-std::atan(best.y * scale_v / camera.fy), std::atan(best.x * scale_u / camera.fx), 0.0});
}

}  // namespace panvo::binocular_odometry
