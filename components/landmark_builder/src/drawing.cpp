// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/drawing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace panvo::landmark_builder {
namespace {

const cv::Scalar kYellow(0, 220, 255), kBlue(255, 120, 0), kRed(40, 40, 255), kGreen(60, 220, 60);

cv::Mat enlarge(const cv::Mat& picture, int scale) {
  cv::Mat large;
  cv::resize(picture, large, {}, scale, scale, cv::INTER_NEAREST);
  return large;
}

void outline(cv::Mat& picture, const cv::Mat& mask, const cv::Scalar& colour, int scale) {
  std::vector<std::vector<cv::Point>> borders;
  cv::findContours(enlarge(mask, scale), borders, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::drawContours(picture, borders, -1, colour, 1);
}

cv::Point at(const Eigen::Vector2d& pixel, int scale) {
  return {static_cast<int>(std::lround((pixel.x() + 0.5) * scale)),
          static_cast<int>(std::lround((pixel.y() + 0.5) * scale))};
}

Eigen::Vector2d ray(double direction_rad) { return {-std::sin(direction_rad), -std::cos(direction_rad)}; }

cv::Mat no_picture(int side) { return {side, side, CV_8UC3, cv::Scalar(0, 0, 0)}; }

void label(cv::Mat& picture, const std::string& text) {
  cv::putText(picture, text, {6, 16}, cv::FONT_HERSHEY_SIMPLEX, 0.45, kYellow, 1, cv::LINE_AA);
}

}  // namespace

cv::Mat draw_birds_eye(const JunctionView& view, int scale) {
  cv::Mat picture;
  if (view.birds_eye.channels() == 1) {
    cv::cvtColor(view.birds_eye, picture, cv::COLOR_GRAY2BGR);
  } else {
    picture = view.birds_eye.clone();
  }
  cv::Mat dark = picture / 3;
  dark.copyTo(picture, view.body);
  picture = enlarge(picture, scale);
  outline(picture, view.learned_from, kYellow, scale);
  return picture;
}

cv::Mat draw_road_ratio(const JunctionView& view, int scale) {
  cv::Mat picture(view.road_ratio.size(), CV_8UC3);
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      const float ratio = view.road_ratio.at<float>(row, column);
      const auto level = cv::saturate_cast<std::uint8_t>(80.0F * std::abs(ratio));
      picture.at<cv::Vec3b>(row, column) = ratio > 0.0F ? cv::Vec3b(0, level, 0) : cv::Vec3b(0, 0, level);
    }
  }
  return enlarge(picture, scale);
}

cv::Mat draw_road(const JunctionView& view, double resolution_m, int scale) {
  cv::Mat picture(view.road.size(), CV_8UC3, cv::Scalar(0, 0, 0));
  picture.setTo(cv::Scalar(90, 90, 90), view.road);
  picture.setTo(cv::Scalar(230, 230, 230), view.passable);
  picture = enlarge(picture, scale);
  cv::circle(picture, at(view.vehicle_px, scale), 3 * scale, kBlue, cv::FILLED);
  for (const RoadArm& arm : view.arms.arms) {
    const Eigen::Vector2d end = view.arms.centre_px + arm.reach_m / resolution_m * ray(arm.direction_rad);
    cv::line(picture, at(view.arms.centre_px, scale), at(end, scale), view.seen ? kGreen : kRed, scale);
  }
  if (!view.arms.reach_m.empty()) {
    cv::circle(picture, at(view.arms.centre_px, scale), 3 * scale, view.seen ? kGreen : kRed, scale);
  }
  const Eigen::Vector2d middle(view.road.cols / 2, view.road.rows / 2);
  for (const RadonPeak& peak : view.peaks) {
    const Eigen::Vector2d along = ray(peak.direction_rad), across(along.y(), -along.x());
    const Eigen::Vector2d foot = middle + peak.offset_m / resolution_m * across;
    const double half = view.road.rows;
    cv::line(picture, at(foot - half * along, scale), at(foot + half * along, scale), view.seen ? kGreen : kRed);
  }
  return picture;
}

cv::Mat draw_radon(const JunctionView& view, int height_px) {
  if (view.radon.lengths_m.empty()) return no_picture(height_px);
  cv::Mat levels, picture;
  cv::normalize(view.radon.lengths_m.t(), levels, 0, 255, cv::NORM_MINMAX, CV_8U);
  cv::applyColorMap(levels, picture, cv::COLORMAP_VIRIDIS);
  const int rows = picture.rows, columns = picture.cols;
  cv::resize(picture, picture, {height_px, height_px}, 0, 0, cv::INTER_NEAREST);
  for (const RadonPeak& peak : view.peaks) {
    const double column = peak.direction_rad / view.radon.direction_step_rad / columns * height_px;
    const double row = (view.radon.middle_offset() + peak.offset_m / view.radon.offset_step_m) / rows * height_px;
    cv::circle(picture, cv::Point(static_cast<int>(column), static_cast<int>(row)), 6, kRed, 2, cv::LINE_AA);
  }
  return picture;
}

cv::Mat draw_ray_radon(const JunctionView& view, double arm_length_m, int height_px) {
  const auto& reach_m = view.arms.reach_m;
  if (reach_m.empty()) return no_picture(height_px);
  cv::Mat picture(height_px, height_px, CV_8UC3, cv::Scalar(30, 30, 30));
  const double px_per_m = 0.7 * height_px / arm_length_m;
  const auto height = [&](double m) { return height_px - 1 - static_cast<int>(std::lround(m * px_per_m)); };
  for (int column = 0; column < height_px; ++column) {
    const auto i = static_cast<std::size_t>(column) * reach_m.size() / static_cast<std::size_t>(height_px);
    const bool is_long = reach_m[i] >= arm_length_m;
    cv::line(picture, {column, height_px - 1}, {column, height(reach_m[i])},
             is_long ? kGreen : cv::Scalar(140, 140, 140));
  }
  cv::line(picture, {0, height(arm_length_m)}, {height_px - 1, height(arm_length_m)}, kYellow);
  return picture;
}

cv::Mat draw_junction_view(const JunctionView& view, const JunctionDetectorParameters& parameters, int scale) {
  std::vector<cv::Mat> pictures{draw_birds_eye(view, scale), draw_road_ratio(view, scale),
                                draw_road(view, parameters.ground.resolution_m, scale)};
  const int side = pictures.front().rows;
  pictures.push_back(parameters.criterion == "radon" ? draw_radon(view, side)
                                                     : draw_ray_radon(view, parameters.arms.arm_length_m, side));
  const char* const labels[] = {"bird's eye", "road ratio", view.seen ? "road: junction" : "road", "Radon field"};
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (pictures[i].rows != side) cv::resize(pictures[i], pictures[i], {side, side}, 0, 0, cv::INTER_AREA);
    label(pictures[i], labels[i]);
  }
  cv::Mat all;
  cv::hconcat(pictures, all);
  return all;
}

}  // namespace panvo::landmark_builder
