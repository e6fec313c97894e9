// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "painters.hpp"

namespace panvo::simulated_world {
namespace {

/// Fades a picture of marks to 0 at its borders, for overlays whose periods are rotated randomly.
void fade_at_borders(cv::Mat1f& deviation, float border_share) {
  const auto size = static_cast<float>(deviation.cols);
  for (int row = 0; row < deviation.rows; ++row) {
    for (int column = 0; column < deviation.cols; ++column) {
      const auto inset =
          static_cast<float>(std::min({row, column, deviation.rows - 1 - row, deviation.cols - 1 - column}));
      deviation(row, column) *= smooth_step(0.0f, border_share, inset / size);
    }
  }
}

constexpr int kRoadSize = 1024;

/// Adds stains of oil and water.
void add_stains(cv::Mat1f& deviation, const Random& random) {
  const cv::Mat1f stain = fractal_noise(kRoadSize, {7, 7}, 5, 0.5f, random.part(2));
  const cv::Mat1f pale = fractal_noise(kRoadSize, {6, 6}, 6, 0.6f, random.part(3));
  for (int row = 0; row < kRoadSize; ++row) {
    for (int column = 0; column < kRoadSize; ++column) {
      deviation(row, column) +=
          -0.16f * smooth_step(1.1f, 2.2f, stain(row, column)) + 0.12f * smooth_step(1.2f, 2.4f, pale(row, column));
    }
  }
}

/// Clusters of small dark spots.
cv::Mat1f draw_drips(Random places) {
  cv::Mat1f drips = cv::Mat1f::zeros(kRoadSize, kRoadSize);
  for (int swarm = 0; swarm < 7; ++swarm) {
    const cv::Point2f centre = somewhere(kRoadSize, places);
    const int count = 5 + places.below(18);
    for (int drip = 0; drip < count; ++drip) {
      const auto aside = static_cast<float>(40.0 * places.gaussian());
      const cv::Point2f at = centre + cv::Point2f(aside, static_cast<float>(40.0 * places.gaussian()));
      const int radius = 1 + places.below(5);
      cv::circle(drips, at, radius, 0.15 + 0.3 * places.uniform(), cv::FILLED);
    }
  }
  return drips;
}

/// Branching cracks. `lines` goes on from one kind of line to the next, `random` gives each line its course.
cv::Mat1f draw_cracks(int count, const Random& random, Random& lines) {
  cv::Mat1f cracks = cv::Mat1f::zeros(kRoadSize, kRoadSize);
  for (int number = 0; number < count; ++number) {
    const auto direction = static_cast<float>(lines.uniform(0.0, kTurn));
    const auto length = static_cast<float>(lines.uniform(150.0, 620.0));
    const cv::Point2f start = somewhere(kRoadSize, lines);
    const auto trunk = wandering_line(start, direction, length, 6.0f, 0.45f, random.part(100 + number));
    draw_line(cracks, trunk, 1.0f, lines.chance(0.4) ? 2.0f : 1.0f);
    const int branches = lines.below(5);
    for (int branch = 0; branch < branches; ++branch) {
      const cv::Point2f from = trunk[lines.below(static_cast<int>(trunk.size()))];
      const float sign = lines.chance(0.5) ? 1.0f : -1.0f;
      const float side = direction + sign * static_cast<float>(lines.uniform(0.5, 1.3));
      const auto reach = static_cast<float>(lines.uniform(30.0, 170.0));
      draw_line(cracks, wandering_line(from, side, reach, 6.0f, 0.7f, random.part(200 + number * 8 + branch)), 1.0f,
                1.0f);
    }
  }
  return cracks;
}

/// Seams sealed with tar.
cv::Mat1f draw_seams(const Random& random, Random& lines) {
  cv::Mat1f seams = cv::Mat1f::zeros(kRoadSize, kRoadSize);
  for (int number = 0; number < 3; ++number) {
    const auto direction = static_cast<float>(lines.uniform(0.0, kTurn));
    const cv::Point2f start = somewhere(kRoadSize, lines);
    const auto length = static_cast<float>(lines.uniform(250.0, 700.0));
    const auto seam = wandering_line(start, direction, length, 7.0f, 0.11f, random.part(50 + number));
    draw_line(seams, seam, 1.0f, static_cast<float>(lines.uniform(4.0, 7.0)));
  }
  return seams;
}

/// Adds alligator cracks where the base failed.
void add_alligator_cracks(cv::Mat1f& cracks, const Random& random) {
  const Paving scales = crazy_paving(kRoadSize, 60, 0.9f, random.part(6));
  const cv::Mat1f weak = fractal_noise(kRoadSize, {4, 4}, 3, 0.5f, random.part(7));
  for (int row = 0; row < kRoadSize; ++row) {
    for (int column = 0; column < kRoadSize; ++column) {
      const float there = smooth_step(1.7f, 2.3f, weak(row, column));
      const float line = 1.0f - smooth_step(0.03f, 0.1f, scales.to_edge(row, column));
      cracks(row, column) = std::max(cracks(row, column), there * line);
    }
  }
}

/// Skid marks: pairs of dark arcs.
cv::Mat1f draw_skids(const Random& random, Random& lines) {
  cv::Mat1f skids = cv::Mat1f::zeros(kRoadSize, kRoadSize);
  for (int number = 0; number < 2; ++number) {
    const auto direction = static_cast<float>(lines.uniform(0.0, kTurn));
    const cv::Point2f start = somewhere(kRoadSize, lines);
    const cv::Point2f aside = cv::Point2f(-std::sin(direction), std::cos(direction)) * 125.0f;
    const auto length = static_cast<float>(lines.uniform(200.0, 500.0));
    for (const cv::Point2f& from : {start, start + aside}) {
      draw_line(skids, wandering_line(from, direction, length, 30.0f, 0.08f, random.part(70 + number)), 1.0f, 14.0f);
    }
  }
  return skids;
}

}  // namespace

cv::Mat1f paint_road_wear(float amount, Random random) {
  const cv::Mat1f broad = fractal_noise(kRoadSize, {3, 3}, 6, 0.55f, random.part(0));
  const cv::Mat1f fine = fractal_noise(kRoadSize, {24, 24}, 4, 0.7f, random.part(1));
  cv::Mat1f deviation = 0.09f * broad + 0.06f * fine;
  add_stains(deviation, random);
  deviation -= blurred(draw_drips(random.part(4)), 1.2);

  Random lines = random.part(5);
  cv::Mat1f cracks = draw_cracks(static_cast<int>(9 * amount), random, lines);
  const cv::Mat1f seams = draw_seams(random, lines);
  add_alligator_cracks(cracks, random);
  deviation -= 0.5f * blurred(cracks, 0.6) + 0.1f * blurred(cracks, 4.0);
  deviation -= 0.45f * blurred(seams, 1.0);

  const cv::Mat1f skids = blurred(draw_skids(random, lines), 4.0);
  for (int row = 0; row < kRoadSize; ++row) {
    for (int column = 0; column < kRoadSize; ++column) {  // partly worn off
      deviation(row, column) -= 0.16f * skids(row, column) * smooth_step(-0.6f, 1.2f, fine(row, column));
    }
  }
  fade_at_borders(deviation, 0.06f);
  return cv::max(1.0f + deviation, 0.15f);
}

cv::Mat1f paint_ground_wear(float amount, Random random) {
  constexpr int kSize = 512;
  const cv::Mat1f broad = fractal_noise(kSize, {3, 3}, 5, 0.6f, random.part(0));
  const cv::Mat1f stain = fractal_noise(kSize, {8, 8}, 5, 0.55f, random.part(1));
  cv::Mat1f deviation = 0.07f * broad;
  cv::Mat1f spots = cv::Mat1f::zeros(kSize, kSize);  // chewing gum, droppings, leaves
  Random places = random.part(2);
  for (int spot = 0; spot < 90; ++spot) {
    const double shade = places.chance(0.75) ? places.uniform(0.2, 0.5) : -places.uniform(0.2, 0.4);
    const cv::Point2f at = somewhere(kSize, places);
    cv::circle(spots, at, 1 + places.below(3), shade, cv::FILLED);
  }
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      deviation(row, column) +=
          -0.18f * smooth_step(0.9f, 2.2f, stain(row, column)) + 0.10f * smooth_step(1.0f, 2.2f, -stain(row, column));
    }
  }
  deviation -= blurred(spots, 0.8);
  deviation *= amount;
  fade_at_borders(deviation, 0.08f);
  return cv::max(1.0f + deviation, 0.2f);
}

cv::Mat1f paint_wall_wear(float streaks, float repairs, Random random) {
  constexpr int kSize = 1024;  // covers 16 m, lowest row at the ground
  const cv::Mat1f broad = fractal_noise(kSize, {4, 4}, 6, 0.55f, random.part(0));
  const cv::Mat1f rain = fractal_noise(kSize, {70, 3}, 3, 0.65f, random.part(1));
  const cv::Mat1f where = fractal_noise(kSize, {6, 4}, 4, 0.5f, random.part(2));
  const cv::Mat1f splash = fractal_noise(kSize, {30, 12}, 4, 0.6f, random.part(3));
  cv::Mat1f deviation(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    const float height_m = 16.0f * static_cast<float>(kSize - 1 - row) / kSize;
    for (int column = 0; column < kSize; ++column) {
      const float streak = smooth_step(0.1f, 2.0f, rain(row, column)) * smooth_step(-0.3f, 1.3f, where(row, column));
      const float pale = smooth_step(0.4f, 2.2f, -rain(row, column)) * smooth_step(0.0f, 1.5f, -where(row, column));
      // Rain splashes soil on the lowest half metre; damp rises unevenly.
      const float reach_m = 0.55f + 0.3f * splash(row, column);
      const float dirt = 1.0f - smooth_step(0.0f, std::max(reach_m, 0.1f), height_m);
      deviation(row, column) =
          0.05f * broad(row, column) - 0.22f * streaks * streak + 0.08f * streaks * pale - 0.28f * dirt;
    }
  }
  // Repairs: patches of slightly different plaster, with a rim.
  Random places = random.part(4);
  const int patches = static_cast<int>(6.0f * repairs);
  for (int patch = 0; patch < patches; ++patch) {
    const int width = 20 + places.below(80);
    const int height = 20 + places.below(60);
    const cv::Rect box{places.below(kSize), places.below(kSize), width, height};
    const auto step = static_cast<float>(places.uniform(-0.12, 0.12));
    for (const cv::Point& offset : tiling_offsets(box, kSize)) {
      const cv::Rect shown = (box + offset) & cv::Rect(0, 0, kSize, kSize);
      deviation(shown) += step;
    }
  }
  cv::Mat1f cracks = cv::Mat1f::zeros(kSize, kSize);
  for (int crack = 0; crack < static_cast<int>(5.0f * repairs); ++crack) {
    const cv::Point2f from{static_cast<float>(places.uniform(0.0, kSize)),
                           static_cast<float>(places.uniform(0.0, kSize))};
    const auto direction = static_cast<float>(places.uniform(0.8, 2.3));
    draw_line(cracks,
              wandering_line(from, direction, static_cast<float>(places.uniform(60.0, 260.0)), 5.0f, 0.8f,
                             random.part(10 + crack)),
              1.0f, 1.0f);
  }
  deviation -= 0.4f * blurred(cracks, 0.5);
  return cv::max(1.0f + deviation, 0.25f);
}

}  // namespace panvo::simulated_world
