// SPDX-License-Identifier: Apache-2.0
#include "noise.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace panvo::simulated_world {
namespace {

void standardise(cv::Mat1f& picture) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(picture, mean, deviation);
  picture = (picture - mean[0]) / std::max(deviation[0], 1e-9);
}

cv::Mat1f unscaled_smooth_noise(int size, cv::Size cells, Random random) {
  cells = {std::min(cells.width, size), std::min(cells.height, size)};
  constexpr int kMargin = 3;  // cells, so that the cubic kernel wraps around
  cv::Mat1f lattice(cells);
  for (float& value : lattice) value = static_cast<float>(random.uniform(-1.0, 1.0));
  cv::Mat1f padded;
  cv::copyMakeBorder(lattice, padded, kMargin, kMargin, kMargin, kMargin, cv::BORDER_WRAP);
  // An affine map instead of resizing: the number of cells need not divide the size.
  const double scale_x = static_cast<double>(cells.width) / size;
  const double scale_y = static_cast<double>(cells.height) / size;
  const cv::Matx23d lattice_from_picture(scale_x, 0.0, 0.5 * scale_x - 0.5 + kMargin, 0.0, scale_y,
                                         0.5 * scale_y - 0.5 + kMargin);
  cv::Mat1f result;
  cv::warpAffine(padded, result, lattice_from_picture, {size, size}, cv::INTER_CUBIC | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  return result;
}

/// Enlarged by two, wrapping around the borders.
cv::Mat1f enlarged(const cv::Mat1f& picture) {
  cv::Mat1f padded;
  cv::copyMakeBorder(picture, padded, 1, 1, 1, 1, cv::BORDER_WRAP);
  cv::resize(padded, padded, {}, 2.0, 2.0, cv::INTER_LINEAR);
  return padded(cv::Rect(2, 2, 2 * picture.cols, 2 * picture.rows));
}

/// The unscaled sum of octaves. Octaves that are smooth at half the size are computed there, which saves most of the
/// time.
cv::Mat1f octaves_from(int first, int octaves, int size, cv::Size cells, float gain, const Random& random) {
  int coarse = first;
  while (coarse < octaves && std::max(cells.width, cells.height) << coarse <= size / 8) ++coarse;
  const bool halves = coarse > first && size >= 128 && size % 2 == 0;
  cv::Mat1f sum = halves ? enlarged(octaves_from(first, coarse, size / 2, cells, gain, random)).clone()
                         : cv::Mat1f(cv::Mat1f::zeros(size, size));
  for (int octave = halves ? coarse : first; octave < octaves; ++octave) {
    const cv::Size lattice(cells.width << octave, cells.height << octave);
    if (octave > 0 && std::min(lattice.width, lattice.height) > size) break;
    sum += std::pow(gain, static_cast<float>(octave)) * unscaled_smooth_noise(size, lattice, random.part(octave));
  }
  return sum;
}

}  // namespace

cv::Mat1f white_noise(int size, Random random) {
  cv::Mat1f result(size, size);
  for (float& value : result) value = static_cast<float>(random.bits() >> 40) * 0x1.0p-24f;
  return result;
}

cv::Mat1f smooth_noise(int size, cv::Size cells, Random random) {
  cv::Mat1f result = unscaled_smooth_noise(size, cells, random);
  standardise(result);
  return result;
}

cv::Mat1f fractal_noise(int size, cv::Size cells, int octaves, float gain, Random random) {
  cv::Mat1f sum = octaves_from(0, octaves, size, cells, gain, random);
  standardise(sum);
  return sum;
}

cv::Mat1f blurred(const cv::Mat1f& picture, double sigma_x, double sigma_y) {
  const int margin_x = std::min(static_cast<int>(3.0 * sigma_x) + 2, picture.cols);
  const int margin_y = std::min(static_cast<int>(3.0 * sigma_y) + 2, picture.rows);
  cv::Mat1f padded;
  cv::copyMakeBorder(picture, padded, margin_y, margin_y, margin_x, margin_x, cv::BORDER_WRAP);
  cv::GaussianBlur(padded, padded, {2 * margin_x - 1, 2 * margin_y - 1}, std::max(sigma_x, 1e-3),
                   std::max(sigma_y, 1e-3));
  return padded(cv::Rect(margin_x, margin_y, picture.cols, picture.rows)).clone();
}

cv::Mat displaced(const cv::Mat& picture, const cv::Mat1f& dx, const cv::Mat1f& dy) {
  cv::Mat1f x(picture.size()), y(picture.size());
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      x(row, column) = static_cast<float>(column) + dx(row, column);
      y(row, column) = static_cast<float>(row) + dy(row, column);
    }
  }
  cv::Mat result;
  cv::remap(picture, result, x, y, cv::INTER_LINEAR, cv::BORDER_WRAP);
  return result;
}

Paving crazy_paving(int size, int cells, float jitter, Random random) {
  struct Seed {
    float x, y;
    int number;
  };
  // Seeds with a margin of two cells, wrapped around the border.
  const int padded = cells + 4;
  std::vector<Seed> seeds(static_cast<std::size_t>(padded) * padded);
  for (int row = -2; row < cells + 2; ++row) {
    for (int column = -2; column < cells + 2; ++column) {
      const int number = (row + cells) % cells * cells + (column + cells) % cells;
      Random place = random.part(number);
      const auto x = static_cast<float>(place.uniform(-0.5, 0.5));
      const auto y = static_cast<float>(place.uniform(-0.5, 0.5));
      seeds[static_cast<std::size_t>(row + 2) * padded + column + 2] = {
          static_cast<float>(column) + 0.5f + jitter * x, static_cast<float>(row) + 0.5f + jitter * y, number};
    }
  }
  Paving paving{cv::Mat1f(size, size), cv::Mat1f(size, size), cv::Mat1i(size, size)};
  const float cells_per_px = static_cast<float>(cells) / static_cast<float>(size);
  for (int row = 0; row < size; ++row) {
    const float y = (static_cast<float>(row) + 0.5f) * cells_per_px;
    for (int column = 0; column < size; ++column) {
      const float x = (static_cast<float>(column) + 0.5f) * cells_per_px;
      const Seed* first = &seeds[static_cast<std::size_t>(static_cast<int>(y) + 1) * padded + static_cast<int>(x) + 1];
      const Seed* nearest = first;
      const Seed* second = first;
      float least = 1e9f;
      float next = 1e9f;
      for (int down = 0; down < 3; ++down) {
        for (int right = 0; right < 3; ++right) {
          const Seed* seed = first + down * padded + right;
          const float squared = (seed->x - x) * (seed->x - x) + (seed->y - y) * (seed->y - y);
          if (squared < least) {
            next = least;
            second = nearest;
            least = squared;
            nearest = seed;
          } else if (squared < next) {
            next = squared;
            second = seed;
          }
        }
      }
      const float apart_x = second->x - nearest->x;
      const float apart_y = second->y - nearest->y;
      const float between = std::sqrt(apart_x * apart_x + apart_y * apart_y);
      paving.to_seed(row, column) = std::sqrt(least);
      paving.to_edge(row, column) = 0.5f * (next - least) / std::max(between, 1e-6f);
      paving.stone(row, column) = nearest->number;
    }
  }
  return paving;
}

}  // namespace panvo::simulated_world
