// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/body_mask.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "panvo/vision/grey.hpp"

namespace panvo::landmark_builder {
namespace {

constexpr double kStep_m = 0.4;     // between two compared views
constexpr double kFarStep_m = 3.0;  // beyond, two views have little in common
constexpr double kEnough_m = 6.0;   // travelled before the mask is updated
constexpr double kForget = 0.97;    // decay of the sums per step

cv::Mat detail(const cv::Mat& view) {
  cv::Mat grey, smooth, result;
  vision::to_grey(view).convertTo(grey, CV_32F);
  cv::blur(grey, smooth, {9, 9});
  cv::subtract(grey, smooth, result);
  return result;
}

}  // namespace

BodyMask::BodyMask(const BodyMaskParameters& parameters, const GroundGrid& grid)
    : parameters_(parameters), grid_(grid) {
  given_ = cv::Mat::zeros(grid.side, grid.side, CV_8UC1);
  possible_ = cv::Mat::zeros(grid.side, grid.side, CV_8UC1);
  for (int row = 0; row < grid.side; ++row) {
    for (int column = 0; column < grid.side; ++column) {
      const Eigen::Vector2d point = grid.point({column, row});
      const double along = point.x() / std::max(1e-3, point.x() > 0 ? parameters.ahead_m : parameters.behind_m);
      const double across = point.y() / std::max(1e-3, parameters.side_m);
      if (along * along + across * across <= 1.0) given_.at<std::uint8_t>(row, column) = 255;
      if (point.norm() <= parameters.max_distance_m) possible_.at<std::uint8_t>(row, column) = 255;
    }
  }
  given_.copyTo(mask_);
  stays_ = cv::Mat::zeros(grid.side, grid.side, CV_32FC1);
  goes_ = stays_.clone();
}

void BodyMask::learn(const cv::Mat& view, const PlanarPose& odom_from_base) {
  if (!parameters_.learn) return;
  const double step_m = (odom_from_base.position - previous_pose_.position).norm();
  if (!previous_.empty() && step_m < kStep_m) return;
  const cv::Mat current = detail(view);
  if (!previous_.empty() && step_m < kFarStep_m) {
    const auto pixel = [&](double column, double row) {
      return grid_.pixel(previous_pose_.to_base(odom_from_base.to_odom(grid_.point({column, row}))));
    };
    const Eigen::Vector2d origin = pixel(0, 0), right = pixel(1, 0) - origin, down = pixel(0, 1) - origin;
    const cv::Matx23d then_from_now(right.x(), down.x(), origin.x(), right.y(), down.y(), origin.y());
    cv::Mat moved, difference;
    cv::warpAffine(previous_, moved, then_from_now, current.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    cv::absdiff(current, moved, difference);
    cv::addWeighted(goes_, kForget, difference, 1.0, 0.0, goes_);
    cv::absdiff(current, previous_, difference);
    cv::addWeighted(stays_, kForget, difference, 1.0, 0.0, stays_);
    moved_m_ += step_m;
    if (moved_m_ > kEnough_m) update_mask();
  }
  previous_ = current;
  previous_pose_ = odom_from_base;
}

void BodyMask::update_mask() {
  cv::Mat stays, goes;
  cv::blur(stays_, stays, {5, 5});
  cv::blur(goes_, goes, {5, 5});
  cv::Mat candidate = ((stays < goes) & possible_) | given_;
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5});
  cv::morphologyEx(candidate, candidate, cv::MORPH_OPEN, disc);
  cv::Mat whole = candidate | given_;
  // keep only the region connected to the vehicle
  cv::floodFill(whole, {grid_.middle(), grid_.middle()}, 128);
  mask_ = whole == 128;
  cv::dilate(mask_, mask_, disc);
}

}  // namespace panvo::landmark_builder
