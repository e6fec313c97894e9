// SPDX-License-Identifier: Apache-2.0
#include "contact_sheet.hpp"

#include <cmath>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "panvo/vision/equirectangular.hpp"

namespace panvo::places {
namespace {

constexpr vision::Equirectangular kView{540, 270};
constexpr int kTitle_px = 18;
constexpr int kMostLines = 40;  // more hide the picture

/// The view of the query, turned back by so many columns, as the place's panorama sees it.
cv::Mat turned_back(const cv::Mat& view, int columns) {
  const int shift = ((columns % view.cols) + view.cols) % view.cols;
  if (shift == 0) return view;
  cv::Mat turned;
  cv::hconcat(view.colRange(shift, view.cols), view.colRange(0, shift), turned);
  return turned;
}

cv::Mat in_colour(const cv::Mat& grey) {
  cv::Mat small, colour;
  cv::resize(grey, small, {kView.columns, kView.rows}, 0.0, 0.0, cv::INTER_AREA);
  cv::cvtColor(small, colour, cv::COLOR_GRAY2BGR);
  return colour;
}

cv::Point pixel(const Eigen::Vector3d& bearing, int shift, int top) {
  const Eigen::Vector2d at = kView.project(bearing);
  const int u = static_cast<int>(std::lround(at.x())) - shift;
  return {((u % kView.columns) + kView.columns) % kView.columns, static_cast<int>(std::lround(at.y())) + top};
}

}  // namespace

cv::Mat draw_match(const PanoramaImage& query, const PlaceAnswer& answer, const std::vector<KnownPlace>& places,
                   const std::string& title) {
  const bool is_known = answer.shared.view.has_value();
  const double heading_rad = is_known ? answer.shared.view->heading_rad : 0.0;
  const int shift = static_cast<int>(std::lround(heading_rad * kView.columns / (2.0 * std::numbers::pi)));
  cv::Mat picture(kTitle_px + 2 * kView.rows, kView.columns, CV_8UC3, cv::Scalar::all(255));
  cv::putText(picture, title, {4, kTitle_px - 5}, cv::FONT_HERSHEY_SIMPLEX, 0.38, cv::Scalar::all(0), 1, cv::LINE_AA);
  turned_back(in_colour(query.grey), shift).copyTo(picture.rowRange(kTitle_px, kTitle_px + kView.rows));
  if (!is_known) return picture.rowRange(0, kTitle_px + kView.rows).clone();
  const cv::Mat known = cv::imdecode(places[*answer.place].thumbnail, cv::IMREAD_GRAYSCALE);
  if (!known.empty()) in_colour(known).copyTo(picture.rowRange(kTitle_px + kView.rows, picture.rows));
  int drawn = 0;
  for (const auto& pair : answer.shared.agreeing_pairs) {
    const cv::Point from = pixel(pair.panorama, shift, kTitle_px), to = pixel(pair.landmark, 0, kTitle_px + kView.rows);
    if (std::abs(from.x - to.x) > kView.columns / 2) continue;  // across the seam
    if (++drawn > kMostLines) break;
    cv::line(picture, from, to, cv::Scalar(60, 200, 60), 1, cv::LINE_AA);
  }
  return picture;
}

}  // namespace panvo::places
