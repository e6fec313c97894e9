// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/road_junction_detector.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace panvo::landmark_builder {
namespace {

constexpr int kRadonDirections = 90;
constexpr double kPathStep_m = 0.3;
constexpr double kRememberedPath_m = 12.0;
constexpr double kAhead_m = 3.0;  // beyond the body, where the vehicle will drive next
constexpr double kJump_m = 5.0;   // between two panoramas: the odometry was reset

/// Weight of a pixel: the ground area of one panorama row grows with the square of the range.
cv::Mat range_weight(const GroundProjection& projection, double full_weight_range_m) {
  const GroundGrid& grid = projection.grid();
  cv::Mat weight(grid.side, grid.side, CV_32FC1);
  for (int row = 0; row < grid.side; ++row) {
    for (int column = 0; column < grid.side; ++column) {
      const double range_m = (grid.point({column, row}) - projection.camera()).norm();
      const double ratio = full_weight_range_m / std::max(range_m, full_weight_range_m);
      const bool is_inside = range_m <= grid.middle() * grid.resolution_m;
      weight.at<float>(row, column) = is_inside ? static_cast<float>(ratio * ratio) : 0.0F;
    }
  }
  return weight;
}

}  // namespace

RoadJunctionDetector::RoadJunctionDetector(const JunctionDetectorParameters& parameters,
                                           const Eigen::Isometry3d& base_from_panorama, cv::Size panorama_size,
                                           vision::StageObserver* observer)
    : parameters_(parameters),
      observer_(observer),
      projection_(parameters.ground, base_from_panorama, panorama_size),
      range_weight_(range_weight(projection_, parameters.map.full_weight_range_m)),
      body_(parameters.body, projection_.grid()),
      road_model_(parameters.road),
      map_(parameters.map, parameters.ground.resolution_m) {}

JunctionView RoadJunctionDetector::detect(const cv::Mat& panorama, const Eigen::Isometry3d& odom_from_base) {
  const vision::Stage all(observer_, "junction");
  const PlanarPose pose = PlanarPose::of(odom_from_base);
  remember(pose);
  JunctionView view;
  {
    const vision::Stage stage(observer_, "project");
    view.birds_eye = projection_.project(panorama);
  }
  {
    const vision::Stage stage(observer_, "learn");
    body_.learn(view.birds_eye, pose);
    body_.mask().copyTo(view.body);
    view.learned_from = certain_road(pose) & ~view.body;
    road_model_.learn(view.birds_eye, view.learned_from);
  }
  {
    const vision::Stage stage(observer_, "segment");
    view.road_ratio = road_model_.segment(view.birds_eye);
    cv::Mat weight = range_weight_.clone();
    weight.setTo(0.0F, view.body);
    if (!parameters_.gather) map_.clear();
    map_.add(view.road_ratio, weight, projection_.grid(), pose);
    map_.add_footprint(pose);
  }
  const vision::Stage stage(observer_, "judge");
  view.vehicle_px = map_.cell(pose.position);
  cv::Mat smooth;
  cv::blur(map_.evidence(), smooth, {3, 3});
  view.road = smooth > 0.0F;
  const cv::Point vehicle(static_cast<int>(std::lround(view.vehicle_px.x())),
                          static_cast<int>(std::lround(view.vehicle_px.y())));
  view.passable = passable_region(view.road, vehicle, map_.resolution_m(), parameters_.passable);
  judge(view, pose);
  return view;
}

void RoadJunctionDetector::judge(JunctionView& view, const PlanarPose& pose) const {
  if (parameters_.criterion == "radon") {
    // [Lu2015 4.1] "if the number of local maximum values in the radon field of the road binary image is greater than one,
    // the current visiting place is considered as a road junction"
    view.radon = radon_transform(view.passable, map_.resolution_m(), kRadonDirections);
    view.peaks =
        local_maxima(view.radon, parameters_.radon_share, parameters_.radon_separation_deg * std::numbers::pi / 180.0);
    if (view.peaks.size() > 1) view.seen = {pose.position, 2 * static_cast<int>(view.peaks.size())};
    return;
  }
  view.arms = find_best_centre(view.passable, view.vehicle_px, map_.resolution_m(), parameters_.arms);
  const int roads = static_cast<int>(view.arms.arms.size());
  if (roads >= parameters_.min_arms) view.seen = {map_.point(view.arms.centre_px), roads};
}

void RoadJunctionDetector::remember(const PlanarPose& pose) {
  if (!driven_.empty() && (pose.position - driven_.back()).norm() > kJump_m) {
    driven_.clear();
    map_.clear();
  }
  if (driven_.empty() || (pose.position - driven_.back()).norm() >= kPathStep_m) driven_.push_back(pose.position);
  while (static_cast<double>(driven_.size()) * kPathStep_m > kRememberedPath_m) driven_.pop_front();
}

cv::Mat RoadJunctionDetector::certain_road(const PlanarPose& pose) const {
  const GroundGrid& grid = projection_.grid();
  cv::Mat mask = cv::Mat::zeros(grid.side, grid.side, CV_8UC1);
  const auto to_pixel = [&](const Eigen::Vector2d& point_in_base) {
    const Eigen::Vector2d pixel = grid.pixel(point_in_base);
    return cv::Point(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
  };
  const int width =
      std::max(1, static_cast<int>(std::lround(2.0 * parameters_.driven_half_width_m / grid.resolution_m)));
  cv::Point before = to_pixel({0.0, 0.0});
  for (auto place = driven_.rbegin(); place != driven_.rend(); ++place) {
    const cv::Point pixel = to_pixel(pose.to_base(*place));
    cv::line(mask, before, pixel, 255, width);
    before = pixel;
  }
  // ahead, up to the first ground beyond the body
  double ahead_m = 0.0;
  const double max_m = std::min(parameters_.body.max_distance_m, grid.middle() * grid.resolution_m - kAhead_m);
  while (ahead_m < max_m && body_.mask().at<std::uint8_t>(to_pixel({ahead_m, 0.0})) != 0) ahead_m += grid.resolution_m;
  cv::line(mask, to_pixel({0.0, 0.0}), to_pixel({ahead_m + kAhead_m, 0.0}), 255, width);
  return mask;
}

}  // namespace panvo::landmark_builder
