// SPDX-License-Identifier: Apache-2.0
#include "store_pictures.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include "print.hpp"

namespace panvo::landmarks {
namespace {

const cv::Scalar kRed(40, 40, 230), kBlue(230, 110, 20), kBlack(0, 0, 0), kWhite(255, 255, 255), kGrey(160, 160, 160);
constexpr int kTitleRows = 36;

void write(cv::Mat& image, const std::string& text, cv::Point where, const cv::Scalar& colour, double size = 0.5) {
  cv::putText(image, text, where, cv::FONT_HERSHEY_SIMPLEX, size, colour, 1, cv::LINE_AA);
}

/// Text that is readable on any background.
void label(cv::Mat& image, const std::string& text, cv::Point where, const cv::Scalar& colour) {
  int below = 0;
  const auto size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.45, 1, &below);
  cv::rectangle(image, {where.x, where.y - size.height - 4}, {where.x + size.width + 4, where.y + below}, kWhite,
                cv::FILLED);
  write(image, text, {where.x + 2, where.y - 1}, colour, 0.45);
}

cv::Mat panorama_of(const PanoramicLandmark& landmark) {
  cv::Mat panorama(DescriptionBasis::kRows, DescriptionBasis::kColumns, CV_8UC3, cv::Scalar::all(225));
  const cv::Mat small = landmark.thumbnail.empty() ? cv::Mat() : cv::imdecode(landmark.thumbnail, cv::IMREAD_COLOR);
  if (small.empty()) {
    write(panorama, "no thumbnail stored", {20, 40}, kBlack, 0.8);
  } else {
    cv::resize(small, panorama, panorama.size(), 0, 0, cv::INTER_CUBIC);
  }
  return panorama;
}

/// A rectangle of the band, drawn in two parts where it crosses the seam.
void draw_rectangle(cv::Mat& panorama, const vision::BandRectangle& rectangle, int first_row, const cv::Scalar& colour,
                    int thickness) {
  for (const int shift : {0, -panorama.cols}) {
    const cv::Rect part(rectangle.x + shift, first_row + rectangle.y, rectangle.width, rectangle.height);
    if (part.x < panorama.cols && part.x + part.width > 0) {
      cv::rectangle(panorama, part, colour, thickness, cv::LINE_AA);
    }
  }
}

void draw_features(cv::Mat& panorama, std::span<const AdaptiveFeature> features,
                   const vision::MeasurementMatrix& matrix, int first_row, int count) {
  for (const int row : {first_row, first_row + matrix.band().height}) {
    cv::line(panorama, {0, row}, {panorama.cols, row}, kWhite, 1);
  }
  const auto shown = std::min(features.size(), static_cast<std::size_t>(count));
  for (std::size_t rank = shown; rank-- > 0;) {  // the best on top
    const auto& feature = features[rank];
    const bool is_surf = feature.row >= matrix.rows();
    const int row = feature.row - (is_surf ? matrix.rows() : 0);
    if (row >= matrix.rows()) continue;
    const auto& colour = is_surf ? kBlue : kRed;
    for (const auto& element : matrix.row(row)) {
      draw_rectangle(panorama, element.rectangle, first_row, colour, element.sign > 0.0F ? 2 : 1);
    }
    const auto& first = matrix.row(row).front().rectangle;
    label(panorama, print("%zu: %.2f", rank + 1, static_cast<double>(feature.weight)),
          {first.x % panorama.cols + 3, first_row + first.y + 17}, colour);
  }
}

double heading_of(const PanoramicLandmark& landmark) {
  const Eigen::Vector3d forward = landmark.map_from_base.linear().col(0);
  return std::atan2(forward.y(), forward.x());
}

/// Converts map coordinates to pixels.
struct MapView {
  static constexpr int kMargin_px = 70;
  static constexpr int kMaxSide_px = 1400;
  Eigen::Vector2d smallest, largest;
  double px_per_m = 1.0;

  explicit MapView(std::span<const PanoramicLandmark> landmarks)
      : smallest(Eigen::Vector2d::Zero()), largest(Eigen::Vector2d::Zero()) {
    if (!landmarks.empty()) smallest = largest = landmarks.front().map_from_base.translation().head<2>();
    for (const auto& landmark : landmarks) {
      smallest = smallest.cwiseMin(landmark.map_from_base.translation().head<2>());
      largest = largest.cwiseMax(landmark.map_from_base.translation().head<2>());
    }
    px_per_m = kMaxSide_px / std::max((largest - smallest).maxCoeff(), 20.0);
  }
  cv::Size size() const {
    const Eigen::Vector2d extent = (largest - smallest) * px_per_m;
    return {static_cast<int>(extent.x()) + 2 * kMargin_px, static_cast<int>(extent.y()) + 2 * kMargin_px};
  }
  cv::Point operator()(const Eigen::Vector2d& position) const {
    const Eigen::Vector2d px = (position - smallest) * px_per_m;
    return {kMargin_px + static_cast<int>(std::lround(px.x())),
            size().height - kMargin_px - static_cast<int>(std::lround(px.y()))};
  }
};

void draw_scale_bar(cv::Mat& image, double px_per_m) {
  double length_m = 1.0;
  while (length_m * 10.0 * px_per_m < 250.0) length_m *= 10.0;
  for (const double factor : {5.0, 2.0}) {
    if (length_m * factor * px_per_m < 250.0) {
      length_m *= factor;
      break;
    }
  }
  const cv::Point start(20, image.rows - 20);
  cv::line(image, start, {start.x + static_cast<int>(length_m * px_per_m), start.y}, kBlack, 2, cv::LINE_AA);
  write(image, print("%g m", length_m), {start.x, start.y - 8}, kBlack);
}

}  // namespace

cv::Mat draw_landmark(const PanoramicLandmark& landmark, const DescriptionBasis& basis, int count) {
  const cv::Mat panorama = panorama_of(landmark);
  cv::Mat picture(2 * (panorama.rows + kTitleRows), panorama.cols, CV_8UC3, kWhite);
  struct Panel {
    const char* scale;
    const std::vector<AdaptiveFeature>& features;
    const vision::MeasurementMatrix& matrix;
  };
  int row = 0;
  for (const auto& panel : {Panel{"large", landmark.description.large, basis.large},
                            Panel{"small", landmark.description.small, basis.small}}) {
    const auto surf = std::count_if(panel.features.begin(), panel.features.end(),
                                    [&](const auto& feature) { return feature.row >= panel.matrix.rows(); });
    write(
        picture,
        print("landmark %u (%s) at x %.1f m, y %.1f m | %s scale: %zu features, %td of them SURF | red intensity, blue "
              "SURF",
              landmark.id, landmark.is_junction ? "junction" : "by distance", landmark.map_from_base.translation().x(),
              landmark.map_from_base.translation().y(), panel.scale, panel.features.size(), surf),
        {10, row + 24}, kBlack);
    cv::Mat part = picture.rowRange(row + kTitleRows, row + kTitleRows + panorama.rows);
    panorama.copyTo(part);
    draw_features(part, panel.features, panel.matrix, basis.first_row, count);
    row += kTitleRows + panorama.rows;
  }
  return picture;
}

cv::Mat draw_map(std::span<const PanoramicLandmark> landmarks) {
  const MapView view(landmarks);
  cv::Mat image(view.size(), CV_8UC3, kWhite);
  for (const auto& landmark : landmarks) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> spread(landmark.covariance.topLeftCorner<2, 2>());
    const Eigen::Vector2d axes = 2.448 * spread.eigenvalues().cwiseMax(0.0).cwiseSqrt() * view.px_per_m;
    const Eigen::Vector2d longest = spread.eigenvectors().col(1);
    if (axes.y() >= 1.0) {
      cv::ellipse(image, view(landmark.map_from_base.translation().head<2>()),
                  {static_cast<int>(std::min(axes.y(), 1e4)), static_cast<int>(std::min(axes.x(), 1e4))},
                  -std::atan2(longest.y(), longest.x()) * 180.0 / M_PI, 0, 360, kGrey, 1, cv::LINE_AA);
    }
  }
  for (const auto& landmark : landmarks) {
    const auto centre = view(landmark.map_from_base.translation().head<2>());
    const double heading = heading_of(landmark);
    cv::line(image, centre,
             {centre.x + static_cast<int>(18 * std::cos(heading)), centre.y - static_cast<int>(18 * std::sin(heading))},
             kBlack, 2, cv::LINE_AA);
    cv::circle(image, centre, 6, landmark.is_junction ? kRed : kWhite, cv::FILLED, cv::LINE_AA);
    cv::circle(image, centre, 6, kRed, 2, cv::LINE_AA);
    write(image, std::to_string(landmark.id), {centre.x + 9, centre.y - 9}, kBlack);
  }
  draw_scale_bar(image, view.px_per_m);
  write(image, print("%zu landmarks: junctions filled, others hollow; x to the right, y up", landmarks.size()),
        {20, 24}, kBlack);
  return image;
}

}  // namespace panvo::landmarks
