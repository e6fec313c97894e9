// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/radon_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace panvo::landmark_builder {

RadonField radon_transform(const cv::Mat& mask, double resolution_m, int directions) {
  if (mask.empty() || mask.type() != CV_8UC1 || mask.rows != mask.cols || directions < 4) {
    throw std::invalid_argument("Radon transform: needs a square 8-bit mask and at least four directions");
  }
  const int step = resolution_m < 0.4 ? 2 : 1;
  const double cell_m = step * resolution_m;
  const int half = static_cast<int>(std::ceil(0.5 * std::numbers::sqrt2 * mask.rows / step)) + 1;
  RadonField field{cv::Mat::zeros(directions, 2 * half + 1, CV_32FC1), std::numbers::pi / directions, cell_m};
  const int middle = mask.rows / 2;
  std::vector<cv::Point2f> places;  // road pixels relative to the middle, in cells: x up, y left
  for (int row = middle % step; row < mask.rows; row += step) {
    const auto* pixels = mask.ptr<std::uint8_t>(row);
    for (int column = middle % step; column < mask.cols; column += step) {
      if (pixels[column] == 0) continue;
      places.emplace_back(static_cast<float>((middle - row) / step), static_cast<float>((middle - column) / step));
    }
  }
  for (int direction = 0; direction < directions; ++direction) {
    const double angle = direction * field.direction_step_rad;
    const auto x = static_cast<float>(-std::sin(angle)),
               y = static_cast<float>(std::cos(angle));  // of the line's normal
    auto* lengths = field.lengths_m.ptr<float>(direction);
    const float origin = static_cast<float>(half) + 0.5F;
    for (const cv::Point2f& place : places) lengths[static_cast<int>(origin + place.x * x + place.y * y)] += 1.0F;
  }
  field.lengths_m *= cell_m;  // a line of width cell_m: area / width
  return field;
}

std::vector<RadonPeak> local_maxima(const RadonField& field, double share, double separation_rad) {
  cv::Mat smooth;
  cv::blur(field.lengths_m, smooth, {5, 1});
  double highest = 0.0;
  cv::minMaxLoc(smooth, nullptr, &highest);
  std::vector<RadonPeak> candidates;
  if (highest <= 0.0) return candidates;
  const int rows = smooth.rows;
  for (int row = 0; row < rows; ++row) {
    double best = 0.0;
    cv::Point place;
    cv::minMaxLoc(smooth.row(row), nullptr, &best, nullptr, &place);
    if (best < share * highest) continue;
    candidates.push_back(
        {row * field.direction_step_rad, (place.x - field.middle_offset()) * field.offset_step_m, best});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.length_m > b.length_m; });
  std::vector<RadonPeak> peaks;
  const auto is_apart = [&](const RadonPeak& a, const RadonPeak& b) {
    const double difference = std::abs(a.direction_rad - b.direction_rad);
    return std::min(difference, std::numbers::pi - difference) > separation_rad;
  };
  for (const RadonPeak& candidate : candidates) {
    // a maximum: no candidate within the separation is longer, whether chosen or not
    const bool is_highest = std::all_of(candidates.begin(), candidates.end(), [&](const RadonPeak& other) {
      return other.length_m <= candidate.length_m || is_apart(candidate, other);
    });
    if (is_highest &&
        std::all_of(peaks.begin(), peaks.end(), [&](const auto& peak) { return is_apart(candidate, peak); })) {
      peaks.push_back(candidate);
    }
  }
  return peaks;
}

}  // namespace panvo::landmark_builder
