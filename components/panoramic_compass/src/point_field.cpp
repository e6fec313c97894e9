// SPDX-License-Identifier: Apache-2.0
#include "panvo/panoramic_compass/point_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "panvo/vision/corner_detector.hpp"

namespace panvo::panoramic_compass {
namespace {

using vision::PatchTemplate;

constexpr int kRowMargin_px = 16;  // half-size template with its border
constexpr double kHalfReach_px = 8.0, kFullReach_px = 3.0;
constexpr double kPlaceVariance_px2 = 0.03 * 0.03;  // interpolation error of any point
constexpr int kMaxMissed = 3;
constexpr double kSameSize = 0.01;  // relative; at 6 px, half a template, the shift is below pixel noise

double wrapped(double u, int columns) { return u - columns * std::floor(u / columns); }

/// Whether the neighbourhood of a point contains pixels darker than the sky.
bool is_solid(const RoundBand& band, const Eigen::Vector2d& in_margin) {
  if (band.sky_grey > 255.0) return true;
  constexpr int kHalf = PatchTemplate::kSize / 2;
  const cv::Rect around(static_cast<int>(in_margin.x()) - kHalf, static_cast<int>(in_margin.y()) - kHalf, 2 * kHalf,
                        2 * kHalf);
  double darkest = 0.0;
  const cv::Mat& image = band.pyramid[0];
  cv::minMaxLoc(image(around & cv::Rect(0, 0, image.cols, image.rows)), &darkest, nullptr);
  return darkest < band.sky_grey;
}

}  // namespace

bool is_seen(const cv::Mat& seen, const Eigen::Vector2d& in_band) {
  if (seen.empty()) return true;
  const int column = std::clamp(static_cast<int>(in_band.x()), 0, seen.cols - 1);
  const int row = std::clamp(static_cast<int>(in_band.y()), 0, seen.rows - 1);
  return seen.at<std::uint8_t>(row, column) != 0;
}

RoundBand::RoundBand(const cv::Mat& band, double darkest_sky) : columns(band.cols), sky_grey(darkest_sky) {
  cv::Mat round;
  cv::copyMakeBorder(band, round, 0, 0, kMargin_px, kMargin_px, cv::BORDER_WRAP | cv::BORDER_ISOLATED);
  pyramid = vision::ImagePyramid(round, 2);
}

PointField::PointField(const RoundBand& reference, const PointParameters& parameters, const cv::Mat& seen)
    : parameters_(parameters) {
  if (reference.pyramid.levels() < 2) return;
  reference_ = reference.pyramid[0];
  const vision::CellGrid grid(reference.pyramid[0].size(), parameters.spacing_px);
  for (const vision::Corner& corner :
       vision::detect_corners(reference.pyramid, grid, parameters.min_gradient, kRowMargin_px)) {
    const Eigen::Vector2d place = corner.position - Eigen::Vector2d(RoundBand::kMargin_px, 0.0);
    if (place.x() < 0.0 || place.x() >= reference.columns || !is_solid(reference, corner.position)) continue;
    if (!is_seen(seen, place)) continue;
    const auto half = PatchTemplate::sample(reference.pyramid[1], 0.5 * corner.position);
    if (half) points_.push_back({static_cast<int>(points_.size()), place, place, *half, {}});
  }
}

void PointField::keep_seen(const cv::Mat& seen) {
  std::erase_if(points_, [&](const Point& point) { return !is_seen(seen, point.then); });
}

// Resamples the template at the expected magnification. Without it, the position of a roof edge below the sky is biased
// downwards as it comes nearer, and all points along a street share this bias.
void PointField::magnify(Point& point, double magnification) const {
  if (point.full && std::abs(magnification / point.magnified - 1.0) < kSameSize) return;
  point.magnified = magnification;
  point.full = PatchTemplate::sample(reference_, point.then + Eigen::Vector2d(RoundBand::kMargin_px, 0.0),
                                     Eigen::Matrix2d::Identity() / magnification);
}

std::vector<FoundPoint> PointField::find(const RoundBand& now, const Magnification& magnification) {
  std::vector<FoundPoint> found;
  found.reserve(points_.size());
  for (Point& point : points_) {
    point.at.x() = wrapped(point.at.x(), now.columns);
    ++point.missed;
    const Eigen::Vector2d start = point.at + Eigen::Vector2d(RoundBand::kMargin_px, 0.0);
    const auto coarse = point.half.align(now.pyramid[1], 0.5 * start, PatchTemplate::Search::kPlane, kHalfReach_px);
    if (!coarse) continue;
    const Eigen::Vector2d about = 2.0 * coarse->position;
    magnify(point, magnification(point.then, about - Eigen::Vector2d(RoundBand::kMargin_px, 0.0)));
    if (!point.full) continue;
    const auto fine = point.full->align(now.pyramid[0], about, PatchTemplate::Search::kPlane, kFullReach_px);
    if (!fine || fine->correlation < parameters_.min_correlation) continue;
    point.missed = 0;
    point.at = fine->position - Eigen::Vector2d(RoundBand::kMargin_px, 0.0);
    point.at.x() = wrapped(point.at.x(), now.columns);
    found.push_back({point.id, point.then, point.at, fine->variance + Eigen::Vector2d::Constant(kPlaceVariance_px2)});
  }
  std::erase_if(points_, [](const Point& point) { return point.missed >= kMaxMissed; });
  return found;
}

}  // namespace panvo::panoramic_compass
