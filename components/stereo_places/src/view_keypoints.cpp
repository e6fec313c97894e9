// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/view_keypoints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <tuple>

#include "panvo/vision/image_pyramid.hpp"

namespace panvo::stereo_places {
namespace {

using landmarks::Keypoint;

constexpr int kStripes = 8;  // of the image's width, each with an equal share of the keypoints
constexpr int kSurplus = 2;  // detected per keypoint kept, so that every stripe has a choice
constexpr int kLevels = 4;
constexpr double kMaxDisparity_px = -1.0;    // infinity, with a margin, as of the odometry's matches
constexpr double kMinCorrelation = 0.8;      // likewise
constexpr double kNearestBaselines = 5.0;    // likewise
constexpr double kRowFloor_px = 0.15;        // of a row error, as of the odometry's features
constexpr double kDisparityFloor_px = 0.25;  // of a blob's centre, which may lie on an edge of depth
constexpr double kFarSigmas = 4.0;           // a disparity below is noise
constexpr double kPanoramaColumns = 1080.0;  // Keypoint::size_px refers to them

bool is_stronger(const cv::KeyPoint& a, const cv::KeyPoint& b) {
  if (a.response != b.response) return a.response > b.response;
  return std::tie(a.pt.y, a.pt.x, a.size, a.angle) < std::tie(b.pt.y, b.pt.x, b.size, b.angle);
}

/// Keypoints with several orientations become one.
void set_upright(std::vector<cv::KeyPoint>& keypoints) {
  for (auto& keypoint : keypoints) keypoint.angle = 0.0F;
  std::sort(keypoints.begin(), keypoints.end(), is_stronger);
  const auto is_same = [](const auto& a, const auto& b) { return a.pt == b.pt && a.size == b.size; };
  keypoints.erase(std::unique(keypoints.begin(), keypoints.end(), is_same), keypoints.end());
}

/// The strongest ones, with an equal share for each stripe first.
std::vector<cv::KeyPoint> choose(std::vector<cv::KeyPoint> found, int width, int most) {
  std::sort(found.begin(), found.end(), is_stronger);
  const int share = (most + kStripes - 1) / kStripes;
  std::array<int, kStripes> taken{};
  std::vector<cv::KeyPoint> chosen, others;
  for (const auto& keypoint : found) {
    const int stripe =
        std::clamp(static_cast<int>(keypoint.pt.x * kStripes / static_cast<float>(width)), 0, kStripes - 1);
    (taken[static_cast<std::size_t>(stripe)]++ < share ? chosen : others).push_back(keypoint);
  }
  chosen.insert(chosen.end(), others.begin(), others.end());
  if (chosen.size() > static_cast<std::size_t>(most)) chosen.resize(static_cast<std::size_t>(most));
  std::sort(chosen.begin(), chosen.end(), is_stronger);
  return chosen;
}

/// Pixel of the full image of a point in the reduced one: both have pixel centres at integers.
Eigen::Vector2d to_full(const cv::Point2f& point, int factor) {
  const auto full = [&](float value) { return (static_cast<double>(value) + 0.5) * factor - 0.5; };
  return {full(point.x), full(point.y)};
}

Keypoint to_keypoint(const cv::KeyPoint& found, const float* descriptor, int factor,
                     const vision::PinholeCamera& camera) {
  Keypoint keypoint;
  keypoint.bearing = camera.unproject(to_full(found.pt, factor)).normalized().cast<float>();
  const double radians = static_cast<double>(found.size) * factor / camera.fx;
  keypoint.size_px = static_cast<float>(radians * kPanoramaColumns / (2.0 * std::numbers::pi));
  std::transform(descriptor, descriptor + 128, keypoint.descriptor.begin(),
                 [](float value) { return cv::saturate_cast<uchar>(value); });
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
  const auto sift = cv::SIFT::create(kSurplus * parameters.most, 3, parameters.min_contrast);
  std::vector<cv::KeyPoint> found;
  sift->detect(reduced, found);
  if (parameters.upright) set_upright(found);
  auto chosen = choose(std::move(found), reduced.cols, parameters.most);
  if (chosen.empty()) return {};
  cv::Mat descriptors;
  sift->compute(reduced, chosen, descriptors);
  std::vector<Keypoint> keypoints;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    keypoints.push_back(to_keypoint(chosen[i], descriptors.ptr<float>(static_cast<int>(i)), factor, camera));
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
