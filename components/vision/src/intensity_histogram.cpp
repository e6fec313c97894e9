// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/intensity_histogram.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace panvo::vision {
namespace {
constexpr float kReach = 2.0F;  // scales on either side of the offset
}

std::vector<float> intensity_histogram(const cv::Mat& band, const BandNormalisation& normalisation, int bins) {
  std::array<int, 256> counts{};
  for (int y = 0; y < band.rows; ++y) {
    const uchar* grey = band.ptr<uchar>(y);
    for (int x = 0; x < band.cols; ++x) ++counts[grey[x]];
  }
  std::vector<float> histogram(static_cast<std::size_t>(bins), 0.0F);
  const float share = 1.0F / static_cast<float>(band.total());
  for (int grey = 0; grey < 256; ++grey) {
    const float normalised = (static_cast<float>(grey) - normalisation.offset) / normalisation.intensity_scale;
    const float place = (normalised / kReach + 1.0F) * 0.5F * static_cast<float>(bins);
    const int bin = std::clamp(static_cast<int>(std::floor(place)), 0, bins - 1);
    histogram[static_cast<std::size_t>(bin)] += share * static_cast<float>(counts[static_cast<std::size_t>(grey)]);
  }
  return histogram;
}

float histogram_distance(std::span<const float> a, std::span<const float> b) {
  if (a.size() != b.size()) throw std::invalid_argument("histograms of different numbers of bins");
  if (a.size() < 2) return 0.0F;
  float carried = 0.0F, work = 0.0F;
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    carried += a[i] - b[i];
    work += std::abs(carried);
  }
  return work / static_cast<float>(a.size() - 1);
}

}  // namespace panvo::vision
