// SPDX-License-Identifier: Apache-2.0
#include "plan_picture.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace panvo::simulation {

using simulated_world::RoadNetwork;

namespace {

constexpr double kPixelsPerMetre = 3.0;
constexpr double kMargin_m = 25.0;
constexpr int kSubpixelBits = 4;

/// World to picture, in the fixed-point pixels of OpenCV's drawing functions.
class Paper {
 public:
  explicit Paper(const RoadNetwork& roads) {
    for (const auto& road : roads.roads) {
      for (const auto& point : road.centre_line) {
        lowest_ = lowest_.cwiseMin(point);
        highest_ = highest_.cwiseMax(point);
      }
    }
    lowest_.array() -= kMargin_m;
    highest_.array() += kMargin_m;
  }

  cv::Mat blank() const {
    const Eigen::Vector2d size = kPixelsPerMetre * (highest_ - lowest_);
    return {static_cast<int>(size.y()), static_cast<int>(size.x()), CV_8UC3, cv::Scalar(215, 228, 214)};
  }

  cv::Point at(const Eigen::Vector2d& point) const {
    const double scale = kPixelsPerMetre * (1 << kSubpixelBits);
    return {static_cast<int>(scale * (point.x() - lowest_.x())), static_cast<int>(scale * (highest_.y() - point.y()))};
  }

 private:
  Eigen::Vector2d lowest_{1e9, 1e9}, highest_{-1e9, -1e9};
};

void draw_line(cv::Mat& picture, const Paper& paper, const std::vector<Eigen::Vector2d>& points, double width_m,
               const cv::Scalar& colour) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    cv::line(picture, paper.at(points[i - 1]), paper.at(points[i]), colour,
             std::max(1, static_cast<int>(std::lround(width_m * kPixelsPerMetre))), cv::LINE_AA, kSubpixelBits);
  }
}

}  // namespace

cv::Mat plan_picture(const RoadNetwork& roads, const DrivenPath& path) {
  const Paper paper(roads);
  cv::Mat picture = paper.blank();
  for (const auto& road : roads.roads) draw_line(picture, paper, road.centre_line, road.width_m + 4.0, {190, 200, 205});
  for (const auto& road : roads.roads) draw_line(picture, paper, road.centre_line, road.width_m, {120, 120, 120});
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const double share = path.along_m[i] / path.along_m.back();
    const cv::Scalar colour(255.0 * (1.0 - share), 60.0, 255.0 * share);
    cv::line(picture, paper.at(path.points[i - 1]), paper.at(path.points[i]), colour, 2, cv::LINE_AA, kSubpixelBits);
  }
  for (const auto& junction : roads.junctions) {
    const auto centre = paper.at(junction.position);
    const cv::Scalar colour = junction.has_weak_texture ? cv::Scalar(0, 140, 255) : cv::Scalar(40, 40, 40);
    cv::circle(picture, centre, 6 << kSubpixelBits, colour, junction.is_crossing() ? cv::FILLED : 2, cv::LINE_AA,
               kSubpixelBits);
    const cv::Point text((centre.x >> kSubpixelBits) + 9, (centre.y >> kSubpixelBits) - 9);
    cv::putText(picture, junction.name, text, cv::FONT_HERSHEY_SIMPLEX, 0.45, {255, 255, 255}, 3, cv::LINE_AA);
    cv::putText(picture, junction.name, text, cv::FONT_HERSHEY_SIMPLEX, 0.45, {30, 30, 30}, 1, cv::LINE_AA);
  }
  return picture;
}

}  // namespace panvo::simulation
