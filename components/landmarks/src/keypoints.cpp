// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/keypoints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <tuple>

#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/vision/equirectangular.hpp"

namespace panvo::landmarks {
namespace {

constexpr vision::Equirectangular kPanorama{DescriptionBasis::kColumns, DescriptionBasis::kRows};
constexpr int kMargin = 60;         // px beyond the seam: as far as a descriptor of usual size reaches
constexpr double kContrast = 0.02;  // of grey levels 0 to 1: half of the usual, for skies leave little to buildings
constexpr int kSectors = 24;        // of the full turn, 15 degrees each
constexpr int kMostOfSector = 2;    // times its even share
constexpr int kDescriptor = 128;

/// The band with margins from beyond the seam.
cv::Mat padded_band(const cv::Mat& grey, int first_row, int end_row) {
  const cv::Mat band = grey.rowRange(first_row, end_row);
  cv::Mat padded;
  cv::hconcat(std::vector<cv::Mat>{band.colRange(band.cols - kMargin, band.cols), band, band.colRange(0, kMargin)},
              padded);
  return padded;
}

int squared_distance(const Keypoint& a, const Keypoint& b) {
  int sum = 0;
  for (int i = 0; i < kDescriptor; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const int difference = static_cast<int>(a.descriptor[k]) - static_cast<int>(b.descriptor[k]);
    sum += difference * difference;
  }
  return sum;
}

std::vector<double> azimuths(std::span<const Keypoint> keypoints) {
  std::vector<double> azimuths;
  azimuths.reserve(keypoints.size());
  for (const auto& keypoint : keypoints) {
    azimuths.push_back(
        std::atan2(static_cast<double>(keypoint.bearing.x()), static_cast<double>(keypoint.bearing.z())));
  }
  return azimuths;
}

}  // namespace

std::vector<Keypoint> detect_keypoints(const cv::Mat& panorama, const KeypointParameters& parameters) {
  if (panorama.empty() || (panorama.type() != CV_8UC1 && panorama.type() != CV_8UC3) ||
      panorama.cols != 2 * panorama.rows) {
    throw std::invalid_argument("keypoints: a panorama must be CV_8UC1 or CV_8UC3 and twice as wide as high");
  }
  const int first_row = static_cast<int>(kPanorama.row(-parameters.top_deg * std::numbers::pi / 180.0));
  const int end_row = static_cast<int>(kPanorama.row(parameters.bottom_deg * std::numbers::pi / 180.0));
  cv::Mat band = padded_band(to_described_size(panorama), first_row, end_row);
  double scale = 1.0;
  if (parameters.half_size) {
    cv::Mat half;
    cv::resize(band, half, {}, 0.5, 0.5, cv::INTER_AREA);
    band = half;
    scale = 2.0;
  }
  const auto sift = cv::SIFT::create(0, 3, kContrast, 10.0, 1.6, CV_8U);
  std::vector<cv::KeyPoint> found;
  sift->detect(band, found);
  std::sort(found.begin(), found.end(), [](const cv::KeyPoint& a, const cv::KeyPoint& b) {
    return std::tuple(-a.response, a.pt.x, a.pt.y, a.angle) < std::tuple(-b.response, b.pt.x, b.pt.y, b.angle);
  });

  // the strongest, but no sector may take what the others need: a pose wants bearings all around
  const auto column_of = [&](const cv::KeyPoint& keypoint) {
    return (static_cast<double>(keypoint.pt.x) + 0.5) * scale - 0.5 - kMargin;
  };
  const int most_of_sector = std::max(1, kMostOfSector * parameters.most / kSectors);
  std::vector<int> taken(kSectors, 0);
  std::vector<cv::KeyPoint> chosen;
  for (const auto& keypoint : found) {
    const double column = column_of(keypoint);
    if (column < -0.5 || column >= kPanorama.columns - 0.5) continue;
    const auto sector = static_cast<std::size_t>((column + 0.5) * kSectors / kPanorama.columns);
    if (taken[sector] >= most_of_sector) continue;
    ++taken[sector];
    chosen.push_back(keypoint);
    if (static_cast<int>(chosen.size()) == parameters.most) break;
  }
  std::vector<Keypoint> keypoints(chosen.size());
  if (chosen.empty()) return keypoints;
  // SIFT drops none here and changes no order: each keypoint carries its octave
  cv::Mat descriptors;
  sift->compute(band, chosen, descriptors);
  keypoints.resize(chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const double row = (static_cast<double>(chosen[i].pt.y) + 0.5) * scale - 0.5 + first_row;
    keypoints[i].bearing = kPanorama.unproject({column_of(chosen[i]), row}).cast<float>();
    keypoints[i].size_px = chosen[i].size * static_cast<float>(scale);
    std::copy_n(descriptors.ptr<std::uint8_t>(static_cast<int>(i)), kDescriptor, keypoints[i].descriptor.begin());
  }
  return keypoints;
}

std::vector<KeypointMatch> match_keypoints(std::span<const Keypoint> query, std::span<const Keypoint> landmark,
                                           float ratio, const std::optional<AzimuthWindow>& window) {
  constexpr int kNone = std::numeric_limits<int>::max();
  struct Best {
    int index = -1;
    int distance = kNone;
    int second = kNone;
  };
  std::vector<Best> of_query(query.size());
  std::vector<Best> of_landmark(landmark.size());
  const auto query_azimuths = azimuths(query);
  const auto landmark_azimuths = azimuths(landmark);
  for (std::size_t i = 0; i < query.size(); ++i) {
    auto& best = of_query[i];
    for (std::size_t j = 0; j < landmark.size(); ++j) {
      if (window) {
        // a vehicle turned left sees everything farther to the right
        const double apart = query_azimuths[i] - landmark_azimuths[j] - window->heading_rad;
        if (std::abs(vision::wrap(apart, 2.0 * std::numbers::pi)) > window->half_width_rad) continue;
      }
      const int distance = squared_distance(query[i], landmark[j]);
      if (distance < best.distance) {
        best = {static_cast<int>(j), distance, best.distance};
      } else {
        best.second = std::min(best.second, distance);
      }
      if (distance < of_landmark[j].distance) of_landmark[j] = {static_cast<int>(i), distance, kNone};
    }
  }
  std::vector<KeypointMatch> matches;
  const double ratio2 = static_cast<double>(ratio) * static_cast<double>(ratio);
  for (std::size_t i = 0; i < query.size(); ++i) {
    const auto& best = of_query[i];
    if (best.index < 0 || of_landmark[static_cast<std::size_t>(best.index)].index != static_cast<int>(i)) continue;
    if (best.second != kNone && static_cast<double>(best.distance) >= ratio2 * static_cast<double>(best.second))
      continue;
    matches.push_back({static_cast<int>(i), best.index, std::sqrt(static_cast<float>(best.distance))});
  }
  return matches;
}

}  // namespace panvo::landmarks
