// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/panorama_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace panvo::vision {
namespace {

constexpr int kLargestShift = 8;           // of 72 columns: 40 degrees between two panoramas
constexpr int kSamples = 3;                // a side, of a pixel of the thumbnail
constexpr double kSmallestContrast = 2.0;  // grey levels, standard deviation: below, any two are alike
/// Correlations with the panorama before, from -1 to 1: below `alike`, it may be exchanged, and is where it is above `exchanged` and better
/// by `margin` when it is taken so. Between panoramas that are 0.2 s apart the first is 0.9 and more of all, 0.74 and more of the structure.
struct Likeness {
  double alike, exchanged, margin;
};
constexpr Likeness kOfAll{0.6, 0.7, 0.25}, kOfStructure{0.7, 0.72, 0.05};

int level_at(const cv::Mat& image, int row, int column) {
  const uchar* pixel = image.ptr<uchar>(row) + column * image.channels();
  return image.channels() == 1 ? pixel[0] : pixel[1];
}

// Of norm 1; false where there is nothing to it.
template <class Thumbnail>
bool normalize(Thumbnail& thumbnail, double smallest_contrast) {
  const float norm = thumbnail.norm();
  if (norm < smallest_contrast * std::sqrt(static_cast<double>(thumbnail.size()))) return false;
  thumbnail /= norm;
  return true;
}

}  // namespace

std::optional<std::string> PanoramaWatch::find_fault(const cv::Mat& panorama) {
  if (auto fault = image_.find_fault(panorama)) return fault;
  if (const auto now = view_of(panorama)) {
    if (before_) compare(*before_, *now);
    before_ = now;
  }
  // Turned by half a turn about the direction of view, a camera mirrors and upends.
  if (is_upended_) return is_mirrored_ ? "is upside down" : "is upside down and mirrored";
  if (is_mirrored_) return "is mirrored";
  return std::nullopt;
}

/// First whether above and below are exchanged, which sky and ground tell from afar; then whether left and right are.
void PanoramaWatch::compare(const View& before, View now) {
  const auto is_exchanged = [](const Likeness& needed, double as_it_was, const auto& otherwise) {
    return as_it_was < needed.alike && otherwise() > std::max(needed.exchanged, as_it_was + needed.margin);
  };
  const Thumbnail upended = now.grey.colwise().reverse();
  if (is_exchanged(kOfAll, likeness(before.grey, now.grey, kOfAll.alike), [&] {
        return std::max(likeness(before.grey, upended), likeness(before.grey, upended.rowwise().reverse()));
      })) {
    is_upended_ = !is_upended_;
    now.structure = now.structure.colwise().reverse().eval();
  }
  if (is_exchanged(kOfStructure, likeness(before.structure, now.structure, kOfStructure.alike),
                   [&] { return likeness(before.structure, now.structure.rowwise().reverse()); })) {
    is_mirrored_ = !is_mirrored_;
  }
}

std::optional<PanoramaWatch::View> PanoramaWatch::view_of(const cv::Mat& panorama) {
  if (panorama.depth() != CV_8U || panorama.rows < kSamples * kRows || panorama.cols < kSamples * kColumns) return {};
  View view;
  view.grey.setZero();
  std::array<int, kSamples * kColumns> columns{};  // the middles of as many parts of the width
  for (int i = 0; i < kSamples * kColumns; ++i) {
    columns[static_cast<std::size_t>(i)] = (2 * i + 1) * panorama.cols / (2 * kSamples * kColumns);
  }
  for (int i = 0; i < kSamples * kRows; ++i) {
    const int row = (2 * i + 1) * panorama.rows / (2 * kSamples * kRows);
    for (int j = 0; j < kSamples * kColumns; ++j) {
      const int level = level_at(panorama, row, columns[static_cast<std::size_t>(j)]);
      view.grey(i / kSamples, j / kSamples) += static_cast<float>(level) / (kSamples * kSamples);
    }
  }
  view.grey.array() -= view.grey.mean();
  view.structure = view.grey.colwise() - view.grey.rowwise().mean();
  if (!normalize(view.grey, kSmallestContrast) || !normalize(view.structure, 0.0)) return std::nullopt;
  return view;
}

/// The largest correlation over shifts to either side, from none on; no larger one is looked for beyond `enough`.
double PanoramaWatch::likeness(const Thumbnail& before, const Thumbnail& now, double enough) {
  Eigen::Matrix<float, kRows, kColumns + 2 * kLargestShift, Eigen::RowMajor> wide;
  wide << now.rightCols<kLargestShift>(), now, now.leftCols<kLargestShift>();
  double best = -1.0;
  for (int i = 0; i <= 2 * kLargestShift && best < enough; ++i) {
    const int shift = i % 2 == 0 ? i / 2 : -(i + 1) / 2;
    best = std::max<double>(best, wide.middleCols<kColumns>(kLargestShift + shift).cwiseProduct(before).sum());
  }
  return best;
}

}  // namespace panvo::vision
