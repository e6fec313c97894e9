// SPDX-License-Identifier: Apache-2.0
#include "painters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace panvo::simulated_world {
namespace {

constexpr int kSteps = 1 << 14;

std::uint8_t srgb_from_linear(float value) {
  static const std::array<std::uint8_t, kSteps + 1> table = [] {
    std::array<std::uint8_t, kSteps + 1> entries{};
    for (int step = 0; step <= kSteps; ++step) {
      const double linear = static_cast<double>(step) / kSteps;
      const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
      entries[step] = static_cast<std::uint8_t>(std::lround(255.0 * encoded));
    }
    return entries;
  }();
  return table[static_cast<int>(std::clamp(value, 0.0f, 1.0f) * kSteps + 0.5f)];
}

}  // namespace

cv::Mat encoded_picture(const cv::Mat3f& linear, const cv::Mat1f& alpha) {
  cv::Mat4b result(linear.size());
  for (int row = 0; row < linear.rows; ++row) {
    cv::Vec4b* to = result[linear.rows - 1 - row];
    for (int column = 0; column < linear.cols; ++column) {
      const Colour& colour = linear(row, column);
      const float opacity = alpha.empty() ? 1.0f : std::clamp(alpha(row, column), 0.0f, 1.0f);
      to[column] = {srgb_from_linear(colour[0]), srgb_from_linear(colour[1]), srgb_from_linear(colour[2]),
                    static_cast<std::uint8_t>(std::lround(255.0f * opacity))};
    }
  }
  return result;
}

cv::Mat encoded_overlay(const cv::Mat1f& factor) {
  // Mean 1 exactly, so that an overlay changes no material's albedo.
  const cv::Mat1f half = factor * (0.5 / std::max(cv::mean(factor)[0], 1e-6));
  cv::Mat3f grey;
  cv::merge(std::vector<cv::Mat>{half, half, half}, grey);
  return encoded_picture(grey);
}

Colour varied(const Colour& colour, float brightness, float hue, Random random) {
  const auto all = static_cast<float>(1.0 + brightness * random.uniform(-1.0, 1.0));
  const auto warm = static_cast<float>(hue * random.uniform(-1.0, 1.0));
  const auto green = static_cast<float>(0.3 * hue * random.uniform(-1.0, 1.0));
  return {colour[0] * all * (1.0f + warm), colour[1] * all * (1.0f + green), colour[2] * all * (1.0f - warm)};
}

void add_relief(cv::Mat3f& picture, const cv::Mat1f& height, float reach_px, float strength) {
  const cv::Mat1f around = blurred(height, reach_px);
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      const float over = strength * (height(row, column) - around(row, column));
      picture(row, column) *= over < 0.0f ? 1.0f / (1.0f - over) : 1.0f + 0.5f * over;
    }
  }
}

void flatten(cv::Mat3f& picture, float share) {
  constexpr int kCoarse = 32;
  cv::Mat3f coarse;
  cv::resize(picture, coarse, {kCoarse, kCoarse}, 0.0, 0.0, cv::INTER_AREA);
  const cv::Scalar mean = cv::mean(coarse);
  cv::copyMakeBorder(coarse, coarse, 8, 8, 8, 8, cv::BORDER_WRAP);
  cv::GaussianBlur(coarse, coarse, {9, 9}, 1.6);
  const int scale = picture.cols / kCoarse;
  cv::resize(coarse, coarse, {}, scale, scale, cv::INTER_CUBIC);
  const cv::Mat3f uneven = coarse(cv::Rect(8 * scale, 8 * scale, picture.cols, picture.rows));
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      for (int channel = 0; channel < 3; ++channel) {
        const float there = uneven(row, column)[channel] / static_cast<float>(mean[channel]);
        picture(row, column)[channel] /= 1.0f + share * (there - 1.0f);
      }
    }
  }
}

cv::Point2f somewhere(int size, Random& random) {
  const auto x = static_cast<float>(random.uniform(0.0, size));
  return {x, static_cast<float>(random.uniform(0.0, size))};
}

std::vector<cv::Point> tiling_offsets(const cv::Rect& box, int size) {
  std::vector<cv::Point> offsets;
  for (int y = -size; y <= size; y += size) {
    for (int x = -size; x <= size; x += size) {
      if (((box + cv::Point(x, y)) & cv::Rect(0, 0, size, size)).area() > 0) offsets.emplace_back(x, y);
    }
  }
  return offsets;
}

std::vector<cv::Point2f> wandering_line(cv::Point2f start, float direction_rad, float length_px, float step_px,
                                        float unrest_rad, Random random) {
  std::vector<cv::Point2f> line{start};
  float turn = 0.0f;
  for (float done = 0.0f; done < length_px; done += step_px) {
    turn = 0.75f * turn + unrest_rad * static_cast<float>(random.uniform(-1.0, 1.0));
    const float heading = direction_rad + turn;
    start += cv::Point2f(std::cos(heading), std::sin(heading)) * step_px;
    line.push_back(start);
  }
  return line;
}

void draw_line(cv::Mat1f& picture, const std::vector<cv::Point2f>& line, float value, float width_px) {
  constexpr int kShift = 4;
  std::vector<cv::Point> corners;
  for (const cv::Point2f& corner : line) corners.emplace_back(cvRound(corner.x * 16.0f), cvRound(corner.y * 16.0f));
  cv::Rect box = cv::boundingRect(std::vector<cv::Point2f>(line));
  const int margin = static_cast<int>(width_px) + 2;
  box = {box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin};
  for (const cv::Point& offset : tiling_offsets(box, picture.cols)) {
    std::vector<cv::Point> moved;
    for (const cv::Point& corner : corners) moved.push_back(corner + offset * 16);
    cv::polylines(picture, moved, false, value, std::max(1, cvRound(width_px)), cv::LINE_8, kShift);
  }
}

}  // namespace panvo::simulated_world
