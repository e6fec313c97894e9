// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/panorama_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace panvo::vision {
namespace {

constexpr int kMaxShift = 8;                  // of 72 columns: 40 degrees between two panoramas
constexpr int kSamples = 3;                   // per side of a thumbnail pixel
constexpr double kMinPanoramaContrast = 2.0;  // grey levels, standard deviation; below, panoramas are not comparable
/// Correlation thresholds, -1 to 1. A panorama counts as flipped if its correlation with the previous one is below
/// `alike`, while that of its flipped version is above `exchanged` and better by `margin`. Panoramas 0.2 s apart
/// correlate with at least 0.9 (kOfAll) and 0.74 (kOfStructure).
struct Likeness {
  double alike, exchanged, margin;
};
constexpr Likeness kOfAll{0.6, 0.7, 0.25}, kOfStructure{0.7, 0.72, 0.05};

int level_at(const cv::Mat& image, int row, int column) {
  const uchar* pixel = image.ptr<uchar>(row) + column * image.channels();
  return image.channels() == 1 ? pixel[0] : pixel[1];
}

// Scales to norm 1; false if the contrast is too low.
template <class Thumbnail>
bool normalize(Thumbnail& thumbnail, double min_contrast) {
  const float norm = thumbnail.norm();
  if (norm < min_contrast * std::sqrt(static_cast<double>(thumbnail.size()))) return false;
  thumbnail /= norm;
  return true;
}

}  // namespace

std::optional<std::string> PanoramaWatch::add(const cv::Mat& panorama) {
  if (auto fault = image_.find_fault(panorama)) return fault;
  image_.remember(panorama);
  if (const auto now = view_of(panorama)) {
    if (before_) note_flips(*before_, *now);
    before_ = now;
  }
  // A camera rolled by 180 degrees gives a panorama that is both mirrored and flipped vertically.
  if (is_upended_) return is_mirrored_ ? "is upside down" : "is upside down and mirrored";
  if (is_mirrored_) return "is mirrored";
  return std::nullopt;
}

/// Checks first for a vertical flip, which sky and ground reveal clearly, then for a horizontal flip.
void PanoramaWatch::note_flips(const View& before, View now) {
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
  std::array<int, kSamples * kColumns> columns{};  // centres of equal parts of the width
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
  if (!normalize(view.grey, kMinPanoramaContrast) || !normalize(view.structure, 0.0)) return std::nullopt;
  return view;
}

/// Largest correlation over shifts to both sides, starting from zero; stops once `enough` is reached.
double PanoramaWatch::likeness(const Thumbnail& before, const Thumbnail& now, double enough) {
  Eigen::Matrix<float, kRows, kColumns + 2 * kMaxShift, Eigen::RowMajor> wide;
  wide << now.rightCols<kMaxShift>(), now, now.leftCols<kMaxShift>();
  double best = -1.0;
  for (int i = 0; i <= 2 * kMaxShift && best < enough; ++i) {
    const int shift = i % 2 == 0 ? i / 2 : -(i + 1) / 2;
    best = std::max<double>(best, wide.middleCols<kColumns>(kMaxShift + shift).cwiseProduct(before).sum());
  }
  return best;
}

}  // namespace panvo::vision
