// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/passable_region.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace panvo::landmark_builder {
namespace {

cv::Mat disc(double diameter_m, double resolution_m) {
  const int radius = static_cast<int>(std::lround(0.5 * diameter_m / resolution_m));
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
}

/// Dilation by `radius_m` via a distance transform, at a cost independent of the radius.
cv::Mat grow(const cv::Mat& mask, double radius_m, double resolution_m) {
  cv::Mat distance;
  cv::distanceTransform(~mask, distance, cv::DIST_L2, cv::DIST_MASK_3);
  return distance <= radius_m / resolution_m;
}

void fill_small_holes(cv::Mat& mask, double min_px) {
  cv::Mat labels, stats, centres;
  const int count = cv::connectedComponentsWithStats(~mask, labels, stats, centres, 4, CV_32S);
  std::vector<std::uint8_t> is_small(static_cast<std::size_t>(count), 0);
  for (int i = 1; i < count; ++i) {
    const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    const bool touches_border = box.x == 0 || box.y == 0 || box.br().x == mask.cols || box.br().y == mask.rows;
    is_small[static_cast<std::size_t>(i)] = !touches_border && stats.at<int>(i, cv::CC_STAT_AREA) < min_px;
  }
  for (int row = 0; row < mask.rows; ++row) {
    const auto* label = labels.ptr<int>(row);
    auto* out = mask.ptr<std::uint8_t>(row);
    for (int column = 0; column < mask.cols; ++column) {
      if (is_small[static_cast<std::size_t>(label[column])] != 0) out[column] = 255;
    }
  }
}

}  // namespace

cv::Mat passable_region(const cv::Mat& road, cv::Point vehicle, double resolution_m,
                        const PassableRegionParameters& parameters) {
  if (road.empty() || road.type() != CV_8UC1)
    throw std::invalid_argument("passable region: the road mask must be 8-bit");
  const cv::Mat nothing = cv::Mat::zeros(road.size(), CV_8UC1);
  if (!cv::Rect(0, 0, road.cols, road.rows).contains(vehicle)) return nothing;
  cv::Mat mask;
  cv::morphologyEx(road, mask, cv::MORPH_CLOSE, disc(parameters.close_m, resolution_m));
  fill_small_holes(mask, parameters.min_hole_m2 / (resolution_m * resolution_m));
  // opening: keep pixels within half the width of a pixel that has this much room
  cv::Mat room;
  cv::distanceTransform(mask, room, cv::DIST_L2, cv::DIST_MASK_3);
  const double half_width_m = 0.5 * parameters.narrowest_m;
  cv::Mat open = grow(room >= half_width_m / resolution_m, half_width_m, resolution_m) & mask;
  if (open.at<std::uint8_t>(vehicle) == 0) return nothing;
  cv::floodFill(open, vehicle, 128, nullptr, {}, {}, 4);
  return open == 128;
}

}  // namespace panvo::landmark_builder
