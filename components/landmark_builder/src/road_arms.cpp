// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/road_arms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace panvo::landmark_builder {
namespace {

constexpr double kFarther = 1.35;    // second arm length: roads of a large junction separate only farther out
constexpr double kWidestFan = 2.0;   // adjacent roads can merge to one arm, up to twice as wide, beside two normal arms
constexpr double kScoreOfArm = 1.5;  // value of one more road, m of room
constexpr double kScoreOfJunction = 1000.0;
constexpr double kBeyondArm = 1.45;  // length of the half-lines, in arm lengths

/// Pixel offsets of the steps along all half-lines, shared by all centres.
class RayTable {
 public:
  RayTable(int directions, double max_px) : directions_(directions), steps_(static_cast<int>(max_px)) {
    offsets_.reserve(static_cast<std::size_t>(directions_) * static_cast<std::size_t>(steps_));
    for (int direction = 0; direction < directions_; ++direction) {
      const double angle = 2.0 * std::numbers::pi * direction / directions_;
      for (int step = 1; step <= steps_; ++step) {
        offsets_.emplace_back(static_cast<int>(std::lround(-step * std::sin(angle))),
                              static_cast<int>(std::lround(-step * std::cos(angle))));
      }
    }
  }

  /// Length of the road in each direction, m.
  void reach(const cv::Mat& mask, cv::Point centre, int max_gap, std::vector<float>& out, double resolution_m) const {
    out.resize(static_cast<std::size_t>(directions_));
    const cv::Point* offset = offsets_.data();
    for (int direction = 0; direction < directions_; ++direction, offset += steps_) {
      int last_road = 0;
      for (int step = 1; step <= steps_; ++step) {
        const int column = centre.x + offset[step - 1].x, row = centre.y + offset[step - 1].y;
        if (column < 0 || row < 0 || column >= mask.cols || row >= mask.rows) break;
        if (mask.ptr<std::uint8_t>(row)[column] != 0) {
          last_road = step;
        } else if (step - last_road > max_gap) {
          break;
        }
      }
      out[static_cast<std::size_t>(direction)] = static_cast<float>(last_road * resolution_m);
    }
  }

 private:
  int directions_, steps_;
  std::vector<cv::Point> offsets_;
};

void check(const cv::Mat& mask) {
  if (mask.empty() || mask.type() != CV_8UC1) throw std::invalid_argument("road arms: the road mask must be 8-bit");
}

int in_pixels(double length_m, double resolution_m) { return static_cast<int>(length_m / resolution_m + 0.5); }

cv::Point nearest_pixel(const Eigen::Vector2d& place) {
  return {static_cast<int>(std::lround(place.x())), static_cast<int>(std::lround(place.y()))};
}

}  // namespace

std::vector<float> ray_radon(const cv::Mat& mask, const Eigen::Vector2d& centre_px, double resolution_m, int directions,
                             double max_m, double max_gap_m) {
  check(mask);
  std::vector<float> reach_m;
  RayTable(directions, max_m / resolution_m)
      .reach(mask, nearest_pixel(centre_px), in_pixels(max_gap_m, resolution_m), reach_m, resolution_m);
  return reach_m;
}

std::vector<RoadArm> find_arms(const std::vector<float>& reach_m, const RoadArmsParameters& parameters) {
  std::vector<RoadArm> arms;
  const int count = static_cast<int>(reach_m.size());
  const double step_rad = 2.0 * std::numbers::pi / count;
  const auto is_long = [&](int i) {
    return reach_m[static_cast<std::size_t>((i % count + count) % count)] >= parameters.arm_length_m;
  };
  int start = 0;  // a direction without an arm, so that no arm is split
  while (start < count && is_long(start)) ++start;
  if (start == count) return arms;
  struct Run {
    int first, last;
  };
  std::vector<Run> runs;
  const double gap_steps = parameters.min_gap_m / (parameters.arm_length_m * step_rad);
  // two runs are one arm if the gap between them is narrow or almost as long as the arms
  const auto is_one_arm = [&](int last, int next) {
    float shortest = std::numeric_limits<float>::max();
    for (int i = last + 1; i < next; ++i) shortest = std::min(shortest, reach_m[static_cast<std::size_t>(i % count)]);
    return next - last - 1 < gap_steps || shortest > parameters.deepest_gap * parameters.arm_length_m;
  };
  for (int i = start; i < start + count; ++i) {
    if (!is_long(i)) continue;
    if (!runs.empty() && is_one_arm(runs.back().last, i)) {
      runs.back().last = i;
    } else {
      runs.push_back({i, i});
    }
  }
  if (runs.size() > 1 && is_one_arm(runs.back().last, runs.front().first + count)) {
    runs.front().first = runs.back().first - count;
    runs.pop_back();
  }
  for (const Run& run : runs) {
    const double width_m = (run.last - run.first + 1) * step_rad * parameters.arm_length_m;
    if (width_m < parameters.narrowest_m || width_m > kWidestFan * parameters.widest_m) continue;
    RoadArm arm{std::fmod(0.5 * (run.first + run.last) * step_rad + 2.0 * std::numbers::pi, 2.0 * std::numbers::pi),
                width_m, 0.0};
    for (int i = run.first; i <= run.last; ++i) {
      arm.reach_m = std::max<double>(arm.reach_m, reach_m[static_cast<std::size_t>((i % count + count) % count)]);
    }
    arms.push_back(arm);
  }
  const auto is_wide = [&](const RoadArm& arm) { return arm.width_m > parameters.widest_m; };
  if (std::count_if(arms.begin(), arms.end(), is_wide) + 2 > static_cast<std::ptrdiff_t>(arms.size())) {
    std::erase_if(arms, is_wide);
  }
  std::sort(arms.begin(), arms.end(), [](const auto& a, const auto& b) { return a.direction_rad < b.direction_rad; });
  return arms;
}

RoadArms find_best_centre(const cv::Mat& mask, const Eigen::Vector2d& vehicle_px, double resolution_m,
                          const RoadArmsParameters& parameters) {
  check(mask);
  RoadArms best;
  best.centre_px = vehicle_px;
  double best_score = -1.0;
  cv::Mat room;
  cv::distanceTransform(mask, room, cv::DIST_L2, cv::DIST_MASK_3);
  const RayTable rays(parameters.directions, kBeyondArm * parameters.arm_length_m / resolution_m);
  const int gap = in_pixels(parameters.max_gap_m, resolution_m);
  const int steps = static_cast<int>(parameters.search_radius_m / parameters.search_step_m);
  const double step_px = parameters.search_step_m / resolution_m;
  RoadArmsParameters farther_out = parameters;
  farther_out.arm_length_m *= kFarther;
  std::vector<float> reach_m;
  for (int row = -steps; row <= steps; ++row) {
    for (int column = -steps; column <= steps; ++column) {
      if (row * row + column * column > steps * steps) continue;
      const Eigen::Vector2d centre = vehicle_px + step_px * Eigen::Vector2d(column, row);
      const cv::Point pixel = nearest_pixel(centre);
      if (!cv::Rect(0, 0, mask.cols, mask.rows).contains(pixel)) continue;
      const double room_m = room.at<float>(pixel) * resolution_m;
      if (room_m < parameters.min_room_m) continue;
      rays.reach(mask, pixel, gap, reach_m, resolution_m);
      std::vector<RoadArm> arms = find_arms(reach_m, parameters);
      std::vector<RoadArm> farther = find_arms(reach_m, farther_out);
      if (farther.size() > arms.size()) arms = std::move(farther);
      const double score =
          kScoreOfArm * static_cast<double>(arms.size()) + room_m + (arms.size() > 2 ? kScoreOfJunction : 0.0);
      if (score <= best_score) continue;
      best_score = score;
      best = {centre, room_m, std::move(arms), reach_m};
    }
  }
  return best;
}

}  // namespace panvo::landmark_builder
