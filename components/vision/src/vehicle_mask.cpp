// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/vehicle_mask.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "panvo/vision/angle.hpp"
#include "panvo/vision/grey.hpp"
#include "panvo/vision/seconds.hpp"

namespace panvo::vision {
namespace {

constexpr int kCell_px = 5, kWindow_px = 7;  // of the reduced panorama: 5 degrees
constexpr int kMargin_px = 8;                // at the seam, more than half a window
// Two steps in turn, so that nothing that repeats, such as windows, looks as if it stayed in both.
constexpr std::array kStep_rad{1.5 * kDegree, 2.5 * kDegree};
constexpr std::int64_t kMaxApart_ns = 3 * kSecond_ns;  // slower turns may be drift of odometry
constexpr float kMinEdge = 3.0F;  // rms, grey levels per px: above the noise of a camera and of JPEG
constexpr float kSame = 0.9F, kStayed = 0.7F, kWent = 0.4F;  // correlation of edges
constexpr int kMostStays = 10;                               // points: two for the same, one for what stayed
constexpr int kCovered = 4, kUncovered = 2;                  // points: chance rarely repeats at one place
constexpr double kMaxShare = 0.6;                            // of the band near the horizon that a vehicle covers
constexpr int kHorizon = VehicleMask::kRows / 2;
constexpr int kTopRow = kHorizon - 12, kBottomRow = kHorizon + 3;  // 40 degrees above the horizon to 10 below

/// Steep edges. A turn moves them, unlike the horizon.
cv::Mat edges_of(const cv::Mat& panorama) {
  cv::Mat reduced, wide, across, along;
  cv::resize(to_grey(panorama), reduced, {VehicleMask::kColumns * kCell_px, VehicleMask::kRows * kCell_px}, 0.0, 0.0,
             cv::INTER_AREA);
  cv::copyMakeBorder(reduced, wide, 0, 0, kMargin_px, kMargin_px, cv::BORDER_WRAP);
  cv::Sobel(wide, across, CV_32F, 1, 0, 3, 1.0 / 8.0);
  cv::Sobel(wide, along, CV_32F, 0, 1, 3, 1.0 / 8.0);
  across.setTo(0.0F, cv::abs(along) > cv::abs(across));
  return across;
}

/// Mean around each cell's middle of the product of two pictures of edges.
cv::Mat1f mean_product(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat product, mean;
  cv::multiply(a, b, product);
  cv::boxFilter(product, mean, CV_32F, {kWindow_px, kWindow_px});
  cv::Mat1f cells(VehicleMask::kRows, VehicleMask::kColumns);
  for (int row = 0; row < cells.rows; ++row) {
    const float* means = mean.ptr<float>(row * kCell_px + kCell_px / 2) + kMargin_px + kCell_px / 2;
    for (int column = 0; column < cells.cols; ++column) cells(row, column) = means[column * kCell_px];
  }
  return cells;
}

/// Correlation of the edges in each cell; NaN where there are none.
cv::Mat1f likeness_of(const cv::Mat& before, const cv::Mat& now) {
  const cv::Mat1f both = mean_product(before, now), first = mean_product(before, before),
                  second = mean_product(now, now);
  cv::Mat1f likeness(both.size());
  for (int row = 0; row < both.rows; ++row) {
    for (int column = 0; column < both.cols; ++column) {
      const bool has_edges = std::min(first(row, column), second(row, column)) > kMinEdge * kMinEdge;
      const float strength = std::sqrt(first(row, column) * second(row, column));
      likeness(row, column) = has_edges ? both(row, column) / strength : NAN;
    }
  }
  return likeness;
}

cv::Mat near_horizon(const cv::Mat& cells) { return cells.rowRange(kTopRow, kBottomRow); }

}  // namespace

bool VehicleMask::wants(std::int64_t stamp_ns, double yaw_rad) const {
  return is_too_old_at(stamp_ns) || std::abs(wrapped(yaw_rad - yaw_rad_)) >= kStep_rad.at(steps_ % 2);
}

bool VehicleMask::is_too_old_at(std::int64_t stamp_ns) const {
  return edges_.empty() || stamp_ns < stamp_ns_ || stamp_ns - stamp_ns_ > kMaxApart_ns;
}

bool VehicleMask::add(std::int64_t stamp_ns, const cv::Mat& panorama, double yaw_rad) {
  const bool is_first = is_too_old_at(stamp_ns);
  const cv::Mat before = std::exchange(edges_, edges_of(panorama));
  stamp_ns_ = stamp_ns;
  yaw_rad_ = yaw_rad;
  if (is_first) return false;
  ++steps_;
  const cv::Mat1f likeness = likeness_of(before, edges_);
  const cv::Mat band = near_horizon(likeness);
  const int stayed = cv::countNonZero(band >= kStayed), known = cv::countNonZero(band == band);
  if (stayed > kMaxShare * known) return false;
  const cv::Mat was_seen = seen_.clone();
  judge(likeness);
  return cv::countNonZero(was_seen != seen_) > 0;
}

void VehicleMask::judge(const cv::Mat& likeness) {
  cv::Mat covered(kRows, kColumns, CV_8UC1);
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const float alike = likeness.at<float>(row, column);
      auto& stays = stays_.at<std::uint8_t>(row, column);
      const int points = alike >= kSame ? 2 : alike >= kStayed ? 1 : alike < kWent ? -1 : 0;
      stays = static_cast<std::uint8_t>(std::clamp(stays + points, 0, kMostStays));
      const bool was_covered = seen_.at<std::uint8_t>(row, column) == 0;
      covered.at<std::uint8_t>(row, column) = stays >= kCovered || (was_covered && stays > kUncovered) ? 255 : 0;
    }
  }
  constexpr int kMargin = 2;
  cv::copyMakeBorder(covered, covered, kMargin, kMargin, kMargin, kMargin, cv::BORDER_WRAP);
  cv::morphologyEx(covered, covered, cv::MORPH_CLOSE, cv::Mat());  // parts without edges
  cv::bitwise_not(covered(cv::Rect(kMargin, kMargin, kColumns, kRows)), seen_);
}

cv::Mat to_cells(const cv::Mat& picture) {
  constexpr double kWhite = 250.0;  // of 255: compressed pictures are not quite white
  cv::Mat cells;
  cv::resize(picture, cells, {VehicleMask::kColumns, VehicleMask::kRows}, 0.0, 0.0, cv::INTER_AREA);
  return cells >= kWhite;
}

}  // namespace panvo::vision
