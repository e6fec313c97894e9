// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/keypoints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "panvo/landmarks/sift.hpp"
#include "panvo/vision/equirectangular.hpp"
#include "turn.hpp"

namespace panvo::landmarks {
namespace {

constexpr int kMargin_px = 32;      // beyond the seam: support of a descriptor in the half-size image
constexpr int kFullMargin_px = 96;  // and of the larger scales of the full image
constexpr int kSectors = 24;        // of the full turn, each with an equal share of the keypoints

/// The band of the panorama that is searched, with a margin wrapped from the opposite end on each side.
struct Section {
  cv::Mat image;
  double scale = 1.0;            // px of the panorama per px of the section
  double left = 0.0, top = 0.0;  // px of the panorama at the section's first pixel

  /// Coordinates at pixel centres of the panorama; at half size, section pixels lie between panorama pixels.
  Eigen::Vector2d to_panorama(const cv::Point2f& p) const {
    return {left + (p.x + 0.5) * scale - 0.5, top + (p.y + 0.5) * scale - 0.5};
  }
};

Section cut_section(const cv::Mat& panorama, const KeypointParameters& parameters) {
  const vision::Equirectangular sphere{panorama.cols, panorama.rows};
  const auto row_at = [&](double elevation_deg) {
    const double v = sphere.row(elevation_deg * std::numbers::pi / 180.0);
    return std::clamp(2 * static_cast<int>(std::lround(0.5 * v)), 0, panorama.rows);
  };
  Section section;
  section.top = row_at(-parameters.top_deg);
  const int margin = parameters.half_size ? kMargin_px : kFullMargin_px;
  section.left = -margin;
  const cv::Mat band = panorama.rowRange(row_at(-parameters.top_deg), row_at(parameters.bottom_deg));
  cv::copyMakeBorder(band, section.image, 0, 0, margin, margin, cv::BORDER_WRAP | cv::BORDER_ISOLATED);
  if (parameters.half_size) {
    cv::Mat half;
    cv::resize(section.image, half, section.image.size() / 2, 0.0, 0.0, cv::INTER_AREA);
    section.image = half;
    section.scale = 2.0;
  }
  return section;
}

/// Whether a keypoint lies on a masked pixel, or on the edge of the masked region: that edge would be found anywhere.
bool is_masked(const cv::Mat& mask, const Eigen::Vector2d& pixel, double size_px) {
  const int u = static_cast<int>(std::lround(pixel.x()));
  const auto is_seen = [&](double v, int column) {
    const int row = std::clamp(static_cast<int>(std::lround(v)), 0, mask.rows - 1);
    return mask.at<uchar>(row, ((column % mask.cols) + mask.cols) % mask.cols) != 0;
  };
  const int reach = static_cast<int>(std::lround(size_px));
  return !is_seen(pixel.y(), u) || !is_seen(pixel.y() - size_px, u) || !is_seen(pixel.y() + size_px, u) ||
         !is_seen(pixel.y(), u - reach) || !is_seen(pixel.y(), u + reach);
}

/// Squared Euclidean distance of two descriptors, exact in integers.
int squared_distance(const std::array<std::uint8_t, 128>& a, const std::array<std::uint8_t, 128>& b) {
  cv::v_uint32x4 sum = cv::v_setzero_u32();
  for (std::size_t i = 0; i < a.size(); i += 16) {
    const cv::v_uint8x16 difference = cv::v_absdiff(cv::v_load(&a[i]), cv::v_load(&b[i]));
    sum = cv::v_dotprod_expand(difference, difference, sum);
  }
  return static_cast<int>(cv::v_reduce_sum(sum));
}

double azimuth(const Keypoint& keypoint) { return std::atan2(keypoint.bearing.x(), keypoint.bearing.z()); }

struct Nearest {
  int index = -1;
  int best = std::numeric_limits<int>::max();
  int second = std::numeric_limits<int>::max();

  void see(int candidate, int distance) {
    if (distance < best) {
      second = best;
      best = distance;
      index = candidate;
    } else {
      second = std::min(second, distance);
    }
  }
};

}  // namespace

std::vector<Keypoint> detect_keypoints(const cv::Mat& panorama, const KeypointParameters& parameters,
                                       const cv::Mat& mask) {
  if (panorama.empty() || (panorama.type() != CV_8UC1 && panorama.type() != CV_8UC3) ||
      panorama.cols != 2 * panorama.rows) {
    throw std::invalid_argument("keypoints: the panorama must be CV_8UC1 or CV_8UC3 and twice as wide as high");
  }
  const cv::Mat grey = to_described_size(panorama);
  const vision::Equirectangular sphere{grey.cols, grey.rows};
  const Section section = cut_section(grey, parameters);
  cv::Mat seen;
  if (!mask.empty()) cv::resize(mask, seen, grey.size(), 0.0, 0.0, cv::INTER_NEAREST);
  // Keypoints in the margins are also found at the other end.
  const auto sector_of = [&](const cv::KeyPoint& keypoint) -> std::optional<int> {
    const Eigen::Vector2d pixel = section.to_panorama(keypoint.pt);
    if (pixel.x() < -0.5 || pixel.x() >= grey.cols - 0.5) return std::nullopt;
    if (!seen.empty() && is_masked(seen, pixel, keypoint.size * section.scale)) return std::nullopt;
    return static_cast<int>((pixel.x() + 0.5) * kSectors / grey.cols);
  };
  std::vector<Keypoint> keypoints;
  const SiftRule rule{parameters.most, parameters.min_contrast, parameters.upright, kSectors};
  for (const auto& feature : detect_sift(section.image, rule, sector_of)) {
    Keypoint& keypoint = keypoints.emplace_back();
    keypoint.bearing = sphere.unproject(section.to_panorama(feature.keypoint.pt)).cast<float>();
    keypoint.size_px = static_cast<float>(feature.keypoint.size * section.scale);
    keypoint.descriptor = feature.descriptor;
  }
  return keypoints;
}

DescriptionSettings landmark_settings(const DescriptionParameters& description, const KeypointParameters& keypoints,
                                      std::uint64_t seed) {
  auto settings = description_settings(description, seed);
  // Stores of versions without this parameter have turned descriptors and lack the key.
  if (keypoints.upright) settings["upright_keypoints"] = settings_text(true);
  return settings;
}

std::vector<KeypointMatch> match_keypoints(std::span<const Keypoint> query, std::span<const Keypoint> landmark,
                                           float ratio, const std::optional<AzimuthWindow>& window) {
  std::vector<double> query_azimuths(query.size()), landmark_azimuths(landmark.size());
  std::transform(query.begin(), query.end(), query_azimuths.begin(), azimuth);
  std::transform(landmark.begin(), landmark.end(), landmark_azimuths.begin(), azimuth);
  std::vector<Nearest> of_query(query.size()), of_landmark(landmark.size());
  for (std::size_t i = 0; i < query.size(); ++i) {
    for (std::size_t j = 0; j < landmark.size(); ++j) {
      // Azimuths increase to the right: a point at theta in the landmark is at theta + heading for a vehicle turned
      // left by heading.
      if (window && std::abs(vision::wrap(query_azimuths[i] - landmark_azimuths[j] - window->heading_rad, kTurn)) >
                        window->half_width_rad) {
        continue;
      }
      const int distance = squared_distance(query[i].descriptor, landmark[j].descriptor);
      of_query[i].see(static_cast<int>(j), distance);
      of_landmark[j].see(static_cast<int>(i), distance);
    }
  }
  std::vector<KeypointMatch> matches;
  for (std::size_t i = 0; i < query.size(); ++i) {
    const Nearest& nearest = of_query[i];
    if (nearest.index < 0 || of_landmark[static_cast<std::size_t>(nearest.index)].index != static_cast<int>(i))
      continue;
    const float best = std::sqrt(static_cast<float>(nearest.best));
    if (nearest.second != std::numeric_limits<int>::max() &&
        best > ratio * std::sqrt(static_cast<float>(nearest.second))) {
      continue;
    }
    matches.push_back({static_cast<int>(i), nearest.index, best});
  }
  return matches;
}

}  // namespace panvo::landmarks
