// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/road_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace panvo::landmark_builder {
namespace {

constexpr float kDark = 10.0F;            // grey levels, added so that noise in dark pixels does not count as colour
constexpr std::size_t kMaxSamples = 500;  // per image
constexpr float kLimit = 3.0F;            // limits the influence of one image
constexpr float kMarking = 0.3F;          // log brightness relative to the road's main mode
constexpr float kColourless = 0.12F;      // log ratio of two colours
constexpr GroundColour kMinVariance{0.06F * 0.06F, 0.015F * 0.015F, 0.02F * 0.02F};

struct LogTable {
  std::array<float, 256> values{};
  LogTable() {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::log(static_cast<float>(i) + kDark);
  }
};
const LogTable kLog;

/// The three values of every pixel, one plane each.
struct Planes {
  cv::Mat values[3];
  std::array<const float*, 3> pointers() const {
    return {values[0].ptr<float>(), values[1].ptr<float>(), values[2].ptr<float>()};
  }
  GroundColour at(std::size_t pixel) const {
    const auto planes = pointers();
    return {planes[0][pixel], planes[1][pixel], planes[2][pixel]};
  }
};

Planes to_planes(const cv::Mat& view) {
  if (view.empty() || (view.type() != CV_8UC1 && view.type() != CV_8UC3)) {
    throw std::invalid_argument("road model: the view must be 8-bit grey or 8-bit colour");
  }
  cv::Mat smooth;
  cv::blur(view, smooth, {3, 3});
  Planes planes;
  for (cv::Mat& plane : planes.values) plane.create(view.size(), CV_32FC1);
  auto* brightness = planes.values[0].ptr<float>();
  auto* first = planes.values[1].ptr<float>();
  auto* second = planes.values[2].ptr<float>();
  const auto count = static_cast<std::size_t>(smooth.total());
  const std::uint8_t* pixel = smooth.ptr<std::uint8_t>();
  if (view.channels() == 3) {
    for (std::size_t i = 0; i < count; ++i, pixel += 3) {
      const float b = kLog.values[pixel[0]], g = kLog.values[pixel[1]], r = kLog.values[pixel[2]];
      brightness[i] = g;
      first[i] = r - g;
      second[i] = b - g;
    }
    return planes;
  }
  // Without colour, texture distinguishes asphalt from grass: the deviation of a pixel from its surroundings.
  cv::Mat texture;
  cv::absdiff(view, smooth, texture);
  cv::blur(texture, texture, {5, 5});
  const std::uint8_t* rough = texture.ptr<std::uint8_t>();
  for (std::size_t i = 0; i < count; ++i) {
    brightness[i] = kLog.values[pixel[i]];
    first[i] = 0.05F * (kLog.values[rough[i]] - kLog.values[0]);
    second[i] = 0.0F;
  }
  return planes;
}

/// Up to `most` of the marked pixels, evenly spaced.
std::vector<GroundColour> samples(const Planes& planes, const cv::Mat& marked, std::size_t most) {
  std::vector<std::size_t> places;
  const auto* mark = marked.ptr<std::uint8_t>();
  for (std::size_t i = 0; i < marked.total(); ++i) {
    if (mark[i] != 0) places.push_back(i);
  }
  std::vector<GroundColour> chosen;
  const std::size_t wanted = std::min(most, places.size());
  for (std::size_t i = 0; i < wanted; ++i) chosen.push_back(planes.at(places[i * places.size() / wanted]));
  return chosen;
}

/// Log ratio of road to the better of two alternatives: a constant density of all colours, and the surroundings.
cv::Mat compare(const Planes& planes, const ColourMixture& road, const ColourMixture& surroundings,
                const RoadModelParameters& parameters) {
  cv::Mat ratio(planes.values[0].size(), CV_32FC1, cv::Scalar(0));
  if (road.empty()) return ratio;
  const int count = static_cast<int>(ratio.total());
  auto* out = ratio.ptr<float>();
  road.log_density(planes.pointers(), count, parameters.min_weight, out);
  const auto& main = road.gaussians().front();
  const double peak = -0.5 * std::log(static_cast<double>(main.variance[0]) * main.variance[1] * main.variance[2]);
  const auto anything = static_cast<float>(peak + parameters.threshold);
  std::vector<float> other(static_cast<std::size_t>(count), anything);
  if (!surroundings.empty()) {
    surroundings.log_density(planes.pointers(), count, parameters.min_weight, other.data());
  }
  const auto values = planes.pointers();
  for (int i = 0; i < count; ++i) {
    const float rival = std::max(other[static_cast<std::size_t>(i)], anything);
    out[i] = std::clamp(out[i] - rival, -kLimit, kLimit);
    // a marking or kerb is brighter than the road and colourless; its neighbours decide
    const bool is_marking = values[0][i] > main.mean[0] + kMarking && std::abs(values[1][i]) < kColourless &&
                            std::abs(values[2][i]) < kColourless;
    if (is_marking && out[i] < 0.0F) out[i] = 0.0F;
  }
  return ratio;
}

}  // namespace

RoadModel::RoadModel(const RoadModelParameters& parameters)
    : parameters_(parameters),
      road_(parameters.gaussians, kMinVariance),
      surroundings_(2 * parameters.gaussians, kMinVariance) {}

void RoadModel::learn(const cv::Mat& view, const cv::Mat& certain) {
  if (certain.size() != view.size() || certain.type() != CV_8UC1) {
    throw std::invalid_argument("road model: the mask of certain pixels must be 8-bit and of the view's size");
  }
  const Planes planes = to_planes(view);
  const auto known = samples(planes, certain, kMaxSamples);
  road_.learn(known, road_.empty() ? 1.0 : parameters_.learning_rate);
  if (road_.empty()) return;
  // Pixels that are clearly not road, regardless of the surroundings model, train the surroundings.
  const cv::Mat ratio = compare(planes, road_, ColourMixture(1, kMinVariance), parameters_);
  const cv::Mat clear = ratio <= -kLimit;
  surroundings_.learn(samples(planes, clear, kMaxSamples), surroundings_.empty() ? 1.0 : parameters_.learning_rate);
}

cv::Mat RoadModel::segment(const cv::Mat& view) const {
  return compare(to_planes(view), road_, surroundings_, parameters_);
}

}  // namespace panvo::landmark_builder
