// SPDX-License-Identifier: Apache-2.0
#include "panorama_pair.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "angle_units.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/landmarks/keypoints.hpp"
#include "panvo/position_corrector/five_point_motion.hpp"
#include "panvo/vision/equirectangular.hpp"

namespace panvo::evaluation {
namespace {

constexpr vision::Equirectangular kPanorama{1080, 540};
constexpr int kTop = 132,
              kBottom = 366;  // rows of the band: 46 degrees above the horizon to 32 below, the distinctive part
constexpr int kJpegQuality = 80;
constexpr int kKeypoints = 400;  // for display; more than a landmark keeps
constexpr std::int64_t kSamePanorama_ns = 150'000'000;

cv::Mat read(const std::filesystem::path& file) {
  cv::Mat image = cv::imread(file.string(), cv::IMREAD_COLOR);
  if (image.empty()) throw InputError(file, "cannot be decoded as an image", "record it again or remove it");
  if (image.cols != 2 * image.rows) {
    throw InputError(file, "is not twice as wide as high", "use equirectangular panoramas");
  }
  cv::Mat resized;
  cv::resize(image, resized, {kPanorama.columns, kPanorama.rows}, 0, 0, cv::INTER_AREA);
  return resized;
}

/// Shift of distant objects to the right, in columns.
int columns_of(double heading_rad) {
  const auto shift = static_cast<int>(std::lround(heading_rad * kPanorama.columns / (2.0 * std::numbers::pi)));
  return ((shift % kPanorama.columns) + kPanorama.columns) % kPanorama.columns;
}

cv::Mat turned_back(const cv::Mat& image, int shift) {
  if (shift == 0) return image;  // hconcat rejects an empty part
  cv::Mat turned;
  cv::hconcat(image.colRange(shift, image.cols), image.colRange(0, shift), turned);
  return turned;
}

cv::Mat band_of(const cv::Mat& image) { return image.rowRange(kTop, kBottom); }

std::string jpeg(const cv::Mat& band) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", band, bytes, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  return {bytes.begin(), bytes.end()};
}

Eigen::Vector2d in_band(const landmarks::Keypoint& keypoint, int shift) {
  Eigen::Vector2d pixel = kPanorama.project(keypoint.bearing.cast<double>());
  pixel.x() = std::fmod(pixel.x() - shift + kPanorama.columns, kPanorama.columns);
  pixel.y() -= kTop;
  return pixel;
}

/// Whether both bearings and the translation between the two places are coplanar within the angle.
bool agrees(const landmarks::Keypoint& revisit, const landmarks::Keypoint& landmark,
            const position_corrector::FivePointMotion& motion, double inlier_angle_rad) {
  const Eigen::Vector3d normal = motion.direction.cross(motion.rotation * revisit.bearing.cast<double>());
  if (normal.norm() < 1e-6) return true;
  return std::abs(landmark.bearing.cast<double>().dot(normal.normalized())) <= std::sin(inlier_angle_rad);
}

}  // namespace

PanoramaPair panorama_pair(const std::filesystem::path& landmark, const std::filesystem::path& revisit,
                           double heading_rad) {
  const auto then = read(landmark);
  const auto now = read(revisit);
  const int shift = columns_of(heading_rad);
  PanoramaPair pair;
  pair.columns = kPanorama.columns;
  pair.rows = kBottom - kTop;
  pair.landmark_jpeg = jpeg(band_of(then));
  pair.revisit_jpeg = jpeg(band_of(turned_back(now, shift)));

  const landmarks::KeypointParameters keypoints{.most = kKeypoints};
  const auto known = detect_keypoints(then, keypoints);
  const auto seen = detect_keypoints(now, keypoints);
  const position_corrector::FivePointParameters parameters;
  const auto matches = match_keypoints(
      seen, known, static_cast<float>(parameters.descriptor_ratio),
      landmarks::AzimuthWindow{.heading_rad = heading_rad, .half_width_rad = parameters.azimuth_window_deg * kRadians});
  pair.matches = static_cast<int>(matches.size());
  const auto found = estimate_five_point_motion(seen, known, heading_rad, parameters);
  if (!found.motion) return pair;
  for (const auto& match : matches) {
    const auto& query = seen[static_cast<std::size_t>(match.query)];
    const auto& place = known[static_cast<std::size_t>(match.landmark)];
    if (!agrees(query, place, *found.motion, parameters.inlier_angle_deg * kRadians)) continue;
    pair.inliers.push_back({in_band(place, 0), in_band(query, shift)});
  }
  return pair;
}

cv::Mat3b panorama_band(const std::filesystem::path& file, double heading_rad) {
  return band_of(turned_back(read(file), columns_of(heading_rad)));
}

const RecordedPanorama* panorama_near(const JourneyRecording& recording, std::int64_t stamp_ns) {
  const RecordedPanorama* nearest = nullptr;
  std::int64_t min_ns = kSamePanorama_ns;
  for (const auto& panorama : recording.panoramas) {
    const auto difference_ns = std::abs(panorama.stamp_ns - stamp_ns);
    if (difference_ns > min_ns) continue;
    min_ns = difference_ns;
    nearest = &panorama;
  }
  return nearest;
}

}  // namespace panvo::evaluation
