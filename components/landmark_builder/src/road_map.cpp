// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/road_map.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace panvo::landmark_builder {
namespace {

constexpr float kMaxEvidence = 8.0F;  // limits the inertia, so that changes are accepted within a few views

}  // namespace

PlanarPose PlanarPose::of(const Eigen::Isometry3d& odom_from_base) {
  const Eigen::Vector3d ahead = odom_from_base.linear().col(0);
  return {odom_from_base.translation().head<2>(), std::atan2(ahead.y(), ahead.x())};
}

Eigen::Vector2d PlanarPose::to_odom(const Eigen::Vector2d& point_in_base) const {
  return position + Eigen::Rotation2Dd(yaw_rad) * point_in_base;
}

Eigen::Vector2d PlanarPose::to_base(const Eigen::Vector2d& point_in_odom) const {
  return Eigen::Rotation2Dd(-yaw_rad) * (point_in_odom - position);
}

RoadMap::RoadMap(const RoadMapParameters& parameters, double resolution_m)
    : parameters_(parameters), resolution_m_(resolution_m) {
  const int side = 2 * static_cast<int>(std::lround(parameters.radius_m / resolution_m)) + 1;
  evidence_ = cv::Mat::zeros(side, side, CV_32FC1);
}

void RoadMap::clear() {
  evidence_.setTo(0.0F);
  middle_.reset();
}

Eigen::Vector2d RoadMap::cell(const Eigen::Vector2d& point_in_odom) const {
  const Eigen::Vector2d from_middle =
      point_in_odom / resolution_m_ - middle_.value_or(Eigen::Vector2i::Zero()).cast<double>();
  const double half = evidence_.rows / 2;
  return {half - from_middle.y(), half - from_middle.x()};
}

Eigen::Vector2d RoadMap::point(const Eigen::Vector2d& cell) const {
  const double half = evidence_.rows / 2;
  return resolution_m_ *
         (middle_.value_or(Eigen::Vector2i::Zero()).cast<double>() + Eigen::Vector2d(half - cell.y(), half - cell.x()));
}

void RoadMap::follow(const Eigen::Vector2d& position) {
  const Eigen::Vector2i wanted = (position / resolution_m_).array().round().cast<int>();
  const Eigen::Vector2i shift = middle_ ? Eigen::Vector2i(wanted - *middle_) : Eigen::Vector2i::Zero();
  middle_ = wanted;
  if (shift.isZero()) return;
  const int side = evidence_.rows;
  cv::Mat moved = cv::Mat::zeros(evidence_.size(), evidence_.type());
  // a shift by x cells ahead moves content down by x rows
  const cv::Rect all(0, 0, side, side);
  const cv::Rect target = cv::Rect(shift.y(), shift.x(), side, side) & all;
  if (!target.empty()) evidence_(target - cv::Point(shift.y(), shift.x())).copyTo(moved(target));
  evidence_ = moved;
}

void RoadMap::add(const cv::Mat& ratio, const cv::Mat& weight, const GroundGrid& grid,
                  const PlanarPose& odom_from_base) {
  follow(odom_from_base.position);
  // pixel of the view = view_from_map * cell of the map; affine, so three points determine it
  const auto pixel = [&](double column, double row) {
    return grid.pixel(odom_from_base.to_base(point({column, row})));
  };
  const Eigen::Vector2d origin = pixel(0, 0);
  const Eigen::Vector2d right = pixel(1, 0) - origin;
  const Eigen::Vector2d down = pixel(0, 1) - origin;
  const cv::Matx23d view_from_map(right.x(), down.x(), origin.x(), right.y(), down.y(), origin.y());
  cv::Mat weighted, seen;
  cv::multiply(ratio, weight, weighted);
  cv::warpAffine(weighted, seen, view_from_map, evidence_.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
  evidence_ += seen;
  cv::min(evidence_, kMaxEvidence, evidence_);
  cv::max(evidence_, -kMaxEvidence, evidence_);
}

void RoadMap::add_footprint(const PlanarPose& odom_from_base) {
  follow(odom_from_base.position);
  std::vector<cv::Point> corners;
  for (const auto& [x, y] : {std::pair{parameters_.body_ahead_m, parameters_.body_side_m},
                             std::pair{parameters_.body_ahead_m, -parameters_.body_side_m},
                             std::pair{-parameters_.body_behind_m, -parameters_.body_side_m},
                             std::pair{-parameters_.body_behind_m, parameters_.body_side_m}}) {
    const Eigen::Vector2d place = cell(odom_from_base.to_odom({x, y}));
    corners.emplace_back(static_cast<int>(std::lround(place.x())), static_cast<int>(std::lround(place.y())));
  }
  cv::fillConvexPoly(evidence_, corners, kMaxEvidence);
}

}  // namespace panvo::landmark_builder
