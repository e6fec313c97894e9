// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/view_keypoints.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>

#include "panvo/landmarks/sift.hpp"
#include "panvo/vision/image_pyramid.hpp"

namespace panvo::stereo_places {
namespace {

using landmarks::Keypoint;

constexpr int kStripes = 8;  // of the image's width, each with an equal share of the keypoints
constexpr int kLevels = 4;
constexpr double kMaxDisparity_px = -1.0;    // infinity, with a margin, as of the odometry's matches
constexpr double kMinCorrelation = 0.8;      // likewise
constexpr double kNearestBaselines = 5.0;    // likewise
constexpr double kRowFloor_px = 0.15;        // of a row error, as of the odometry's features
constexpr double kDisparityFloor_px = 0.25;  // of a blob's centre, which may lie on an edge of depth
constexpr double kFarSigmas = 4.0;           // a disparity below is noise
constexpr double kPanoramaColumns = 1080.0;  // Keypoint::size_px refers to them

/// Pixel of the full image of a point in the reduced one: both have pixel centres at integers.
Eigen::Vector2d to_full(const cv::Point2f& point, int factor) {
  const auto full = [&](float value) { return (static_cast<double>(value) + 0.5) * factor - 0.5; };
  return {full(point.x), full(point.y)};
}

Keypoint to_keypoint(const landmarks::SiftFeature& feature, int factor, const vision::PinholeCamera& camera) {
  Keypoint keypoint;
  keypoint.bearing = camera.unproject(to_full(feature.keypoint.pt, factor)).normalized().cast<float>();
  const double radians = static_cast<double>(feature.keypoint.size) * factor / camera.fx;
  keypoint.size_px = static_cast<float>(radians * kPanoramaColumns / (2.0 * std::numbers::pi));
  keypoint.descriptor = feature.descriptor;
  return keypoint;
}

}  // namespace

int reduction(const vision::PinholeCamera& camera, const ViewKeypointParameters& parameters) {
  const double pixels = static_cast<double>(camera.width) * camera.height;
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / parameters.pixels))));
}

std::vector<Keypoint> detect_view_keypoints(const cv::Mat& left, const vision::PinholeCamera& camera,
                                            const ViewKeypointParameters& parameters) {
  if (left.type() != CV_8UC1 || left.cols != camera.width || left.rows != camera.height) {
    throw std::invalid_argument("view keypoints: the image must be CV_8UC1 and of the camera's size");
  }
  const int factor = reduction(camera, parameters);
  cv::Mat reduced = left;
  if (factor > 1) {
    const cv::Size size(left.cols / factor, left.rows / factor);
    cv::resize(left(cv::Rect(0, 0, factor * size.width, factor * size.height)), reduced, size, 0.0, 0.0,
               cv::INTER_AREA);
  }
  const auto stripe_of = [&](const cv::KeyPoint& keypoint) {
    return std::optional(static_cast<int>(keypoint.pt.x * kStripes / static_cast<float>(reduced.cols)));
  };
  std::vector<Keypoint> keypoints;
  const landmarks::SiftRule rule{parameters.most, parameters.min_contrast, parameters.upright, kStripes};
  for (const auto& feature : landmarks::detect_sift(reduced, rule, stripe_of)) {
    keypoints.push_back(to_keypoint(feature, factor, camera));
  }
  return keypoints;
}

ViewDepths::ViewDepths(const vision::RectifiedStereo& stereo)
    : stereo_(stereo),
      matcher_(stereo.camera, {kMaxDisparity_px, stereo.camera.fx / kNearestBaselines}, kMinCorrelation),
      alignment_(stereo.camera) {}

void ViewDepths::keep_measured(std::vector<Keypoint>& keypoints, const cv::Mat& left, const cv::Mat& right,
                               double offset_px, double offset_sigma_px) {
  const vision::ImagePyramid left_levels(left, kLevels), right_levels(right, kLevels);
  const double focal_baseline = stereo_.camera.fx * stereo_.baseline_m;
  const auto is_measured = [&](Keypoint& keypoint) {
    const Eigen::Vector3d ray = keypoint.bearing.cast<double>() / static_cast<double>(keypoint.bearing.z());
    const Eigen::Vector2d pixel = stereo_.camera.project(ray);
    const auto match = matcher_.search(left_levels, right_levels, pixel);
    if (!match) return false;
    if (const auto row = matcher_.row_error(left_levels, right_levels, pixel, *match)) {
      alignment_.add(row->ideal_right_pixel, row->error_px, std::hypot(kRowFloor_px, row->sigma_px));
    }
    const double sigma_px = std::hypot(kDisparityFloor_px, std::sqrt(match->variance_px2), offset_sigma_px);
    const double disparity_px = match->disparity_px - offset_px;
    if (disparity_px < kFarSigmas * sigma_px) return false;
    keypoint.has_point = true;
    keypoint.point_in_panorama = (ray * focal_baseline / disparity_px).cast<float>();
    keypoint.inverse_range_sigma = static_cast<float>(sigma_px / (focal_baseline * ray.norm()));
    return true;
  };
  std::erase_if(keypoints, [&](Keypoint& keypoint) { return !is_measured(keypoint); });
  alignment_.settle();
  matcher_.allow_for(alignment_.misalignment());
}

}  // namespace panvo::stereo_places
