// SPDX-License-Identifier: Apache-2.0
#include "panvo/places/panorama_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "panvo/dataset_player/image_file.hpp"
#include "panvo/landmarks/panorama_check.hpp"
#include "panvo/vision/grey.hpp"

namespace panvo::places {
namespace {

constexpr int kColumns = 1080, kRows = 540;
constexpr int kMinColumns = 60;          // px: at 6 degrees each, a door is one pixel wide
constexpr double kMinHeight_deg = 20.0;  // less shows too little of anything
constexpr double kTallest = 0.55;        // rows per column: 2:1 with a tolerance; photos (16:9: 0.56) are no full turn

struct Rows {
  int first, last;  // of 540, last exclusive
};

/// Rows that the image takes up; nullopt if it cannot be a full turn.
std::optional<Rows> rows_of(const cv::Mat& image, const std::optional<ElevationRange>& range) {
  if (range) {
    const auto row = [](double down_deg) { return static_cast<int>(std::lround((90.0 + down_deg) * kRows / 180.0)); };
    return Rows{std::clamp(row(-range->top_deg), 0, kRows), std::clamp(row(range->bottom_deg), 0, kRows)};
  }
  const double ratio = static_cast<double>(image.rows) / image.cols;
  if (ratio > kTallest) return std::nullopt;
  const int height = std::min(kRows, static_cast<int>(std::lround(ratio * kColumns)));
  const int first = (kRows - height) / 2;
  return Rows{first, first + height};
}

cv::Mat resized(const cv::Mat& image, const cv::Size& size) {
  cv::Mat result;
  cv::resize(image, result, size, 0.0, 0.0, image.cols > size.width ? cv::INTER_AREA : cv::INTER_CUBIC);
  return result;
}

FittedPanorama failed(std::string fault) { return {{}, std::move(fault)}; }

}  // namespace

FittedPanorama fit_panorama(const cv::Mat& image, const std::optional<ElevationRange>& range, const cv::Mat& mask) {
  if (image.empty() || (image.type() != CV_8UC1 && image.type() != CV_8UC3)) return failed("is not an 8-bit image");
  if (image.cols < kMinColumns) return failed(fmt::format("is {} px wide, {} needed", image.cols, kMinColumns));
  const auto rows = rows_of(image, range);
  if (!rows) {
    return failed(
        fmt::format("is no full turn: {}x{} px, at most {:g} rows per column", image.cols, image.rows, kTallest));
  }
  const int height = rows->last - rows->first;
  if (height * 180.0 / kRows < kMinHeight_deg) {
    return failed(
        fmt::format("shows {:.0f} deg from top to bottom, {:g} needed", height * 180.0 / kRows, kMinHeight_deg));
  }
  FittedPanorama fitted;
  fitted.image.file_columns = image.cols;
  cv::copyMakeBorder(resized(vision::to_grey(image), {kColumns, height}), fitted.image.grey, rows->first,
                     kRows - rows->last, 0, 0, cv::BORDER_REPLICATE);
  fitted.image.seen = cv::Mat::zeros(kRows, kColumns, CV_8UC1);
  fitted.image.seen.rowRange(rows->first, rows->last).setTo(255);
  if (!mask.empty()) {
    cv::Mat fitted_mask;
    cv::resize(mask, fitted_mask, {kColumns, height}, 0.0, 0.0, cv::INTER_NEAREST);
    fitted.image.seen.rowRange(rows->first, rows->last).setTo(0, fitted_mask == 0);
  }
  if (auto fault = landmarks::find_fault(fitted.image.grey)) return failed(*fault);
  return fitted;
}

FittedPanorama read_panorama(const std::filesystem::path& file, const std::optional<ElevationRange>& range,
                             const cv::Mat& mask) {
  cv::Mat image;
  dataset_player::ImageDecoder decoder;
  if (const auto fault = decoder.decode(file, dataset_player::Colour::kGrey, image)) {
    const auto name = file.string() + ": ";
    return failed(fault->starts_with(name) ? fault->substr(name.size()) : *fault);
  }
  return fit_panorama(image, range, mask);
}

}  // namespace panvo::places
