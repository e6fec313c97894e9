// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "painters.hpp"

namespace panvo::simulated_world {
namespace {

Colour blended(const Colour& from, const Colour& to, float share) { return from + (to - from) * share; }

}  // namespace

cv::Mat3f paint_bricks(const Colour& brick, const Colour& mortar, float variety, Random random) {
  constexpr int kSize = 1024;
  constexpr int kCourses = 24;  // over a period of 1.92 m: bricks of 24 cm x 8 cm with their joints
  constexpr int kBricks = 8;
  constexpr float kHeight = static_cast<float>(kSize) / kCourses;
  constexpr float kWidth = static_cast<float>(kSize) / kBricks;
  const cv::Mat1f sand = white_noise(kSize, random.part(0));
  const cv::Mat1f chips = fractal_noise(kSize, {60, 60}, 4, 0.7f, random.part(1));
  const cv::Mat1f broad = fractal_noise(kSize, {5, 5}, 5, 0.6f, random.part(2));
  const Random of_brick = random.part(3);
  cv::Mat3f picture(kSize, kSize);
  cv::Mat1f height(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    const int course = std::min(static_cast<int>(static_cast<float>(row) / kHeight), kCourses - 1);
    const float y = static_cast<float>(row) - static_cast<float>(course) * kHeight;
    // English bond: alternating courses of stretchers and headers.
    const bool headers = course % 2 == 1;
    const float width = headers ? 0.5f * kWidth : kWidth;
    for (int column = 0; column < kSize; ++column) {
      const float shifted = static_cast<float>(column) + (headers ? 0.25f * kWidth : 0.0f);
      const int index = static_cast<int>(shifted / width) % (headers ? 2 * kBricks : kBricks);
      const float x = std::fmod(shifted, width);
      const int number = course * 32 + index;
      const float unevenness = 1.4f * (chance_of(of_brick, number, 3) - 0.5f);
      const float edge = std::min({x, y, width - x, kHeight - y}) + unevenness + 0.9f * chips(row, column);
      const float face = smooth_step(2.0f, 4.2f, edge);
      const float shade = 1.0f + variety * (chance_of(of_brick, number) - 0.5f);
      const float tone = variety * (chance_of(of_brick, number, 1) - 0.5f);
      const float burnt = chance_of(of_brick, number, 2) > 0.93f ? 0.6f : 1.0f;
      const Colour own = brick.mul(Colour(1.0f + 0.12f * tone, 1.0f, 1.0f - 0.25f * tone)) * shade * burnt;
      const Colour fired = own * (0.84f + 0.32f * sand(row, column)) * (1.0f + 0.09f * chips(row, column));
      const Colour joint = mortar * (0.75f + 0.5f * sand(row, column)) * (1.0f + 0.08f * broad(row, column));
      picture(row, column) = blended(joint, fired, face) * (1.0f + 0.05f * broad(row, column));
      height(row, column) = face + 0.1f * chips(row, column);
    }
  }
  add_relief(picture, height, 5.0f, 0.4f);
  flatten(picture, 0.5f);
  return picture;
}

cv::Mat3f paint_plaster(const Colour& colour, float roughness, Random random) {
  constexpr int kSize = 512;
  const cv::Mat1f trowel = fractal_noise(kSize, {10, 14}, 5, 0.65f, random.part(0));
  const cv::Mat1f grain = blurred(white_noise(kSize, random.part(1)), 0.8);
  const Paving lumps = crazy_paving(kSize, 90, 1.0f, random.part(2));
  const Random of_lump = random.part(3);
  cv::Mat3f picture(kSize, kSize);
  cv::Mat1f height(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const float lump =
          chance_of(of_lump, lumps.stone(row, column)) * smooth_step(0.0f, 0.4f, lumps.to_edge(row, column));
      height(row, column) = 0.5f * lump + 0.25f * trowel(row, column) + 1.6f * (grain(row, column) - 0.5f);
      picture(row, column) =
          colour * (1.0f + 0.035f * trowel(row, column) + 0.25f * roughness * (grain(row, column) - 0.5f));
    }
  }
  add_relief(picture, height, 3.0f, 0.45f * roughness);
  flatten(picture, 0.9f);
  return picture;
}

cv::Mat3f paint_stone_blocks(const Colour& colour, Random random) {
  constexpr int kSize = 1024;
  constexpr int kCourses = 8;
  const cv::Mat1f sand = white_noise(kSize, random.part(0));
  const cv::Mat1f hewn = fractal_noise(kSize, {30, 40}, 5, 0.7f, random.part(1));
  const cv::Mat1f broad = fractal_noise(kSize, {6, 6}, 6, 0.6f, random.part(2));
  const Random of_block = random.part(3);
  // The joints of each course: blocks of different lengths that end at the period.
  std::vector<std::vector<float>> joints(kCourses);
  for (int course = 0; course < kCourses; ++course) {
    Random lengths = random.part(100 + course);
    const int blocks = 4 + lengths.below(2);
    float total = 0.0f;
    for (int block = 0; block < blocks; ++block) {
      joints[course].push_back(total);
      total += static_cast<float>(lengths.uniform(0.7, 1.3));
    }
    const auto shift = static_cast<float>(lengths.uniform(0.0, 0.2));
    for (float& joint : joints[course]) joint = (joint / total + shift) * kSize;
  }
  cv::Mat3f picture(kSize, kSize);
  cv::Mat1f height(kSize, kSize);
  constexpr float kHeight = static_cast<float>(kSize) / kCourses;
  for (int row = 0; row < kSize; ++row) {
    const int course = row * kCourses / kSize;
    const float y = static_cast<float>(row) - static_cast<float>(course) * kHeight;
    const std::vector<float>& starts = joints[course];
    for (int column = 0; column < kSize; ++column) {
      const auto at = static_cast<float>(column);
      int block = static_cast<int>(starts.size()) - 1;
      while (block > 0 && starts[block] > at) --block;
      const bool before_first = at < starts.front();
      if (before_first) block = static_cast<int>(starts.size()) - 1;
      const float x = at - starts[block] + (before_first ? kSize : 0.0f);
      const float end = block + 1 < static_cast<int>(starts.size()) ? starts[block + 1] : starts.front() + kSize;
      const float width = end - starts[block];
      const float edge = std::min({x, y, width - x, kHeight - y}) + 0.8f * hewn(row, column);
      const int number = course * 16 + block;
      const float tone = chance_of(of_block, number, 1) - 0.5f;
      const Colour own = colour.mul(Colour(1.0f + 0.14f * tone, 1.0f, 1.0f - 0.2f * tone)) *
                         (0.75f + 0.5f * chance_of(of_block, number));
      const Colour stone = own * (0.88f + 0.24f * sand(row, column)) * (1.0f + 0.08f * hewn(row, column)) *
                           (1.0f + 0.07f * broad(row, column));
      const Colour joint = colour * 0.45f * (0.8f + 0.4f * sand(row, column));
      const float face = smooth_step(2.0f, 5.0f, edge);
      picture(row, column) = blended(joint, stone, face);
      height(row, column) = face + 0.3f * smooth_step(5.0f, 14.0f, edge) + 0.14f * hewn(row, column);
    }
  }
  add_relief(picture, height, 7.0f, 0.55f);
  return picture;
}

cv::Mat3f paint_rubble(const Colour& colour, Random random) {
  constexpr int kSize = 1024;
  const cv::Mat1f bend_x = 12.0f * fractal_noise(kSize, {12, 12}, 3, 0.5f, random.part(5));
  const cv::Mat1f bend_y = 9.0f * fractal_noise(kSize, {12, 12}, 3, 0.5f, random.part(6));
  const cv::Mat3f flat = paint_cobbles(11, colour, random.part(0));
  cv::Mat3f picture = displaced(flat, bend_x, bend_y);
  const cv::Mat1f hewn = fractal_noise(kSize, {24, 24}, 6, 0.75f, random.part(1));
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) picture(row, column) *= 1.0f + 0.14f * hewn(row, column);
  }
  add_relief(picture, hewn, 6.0f, 0.25f);
  flatten(picture, 0.6f);
  return picture;
}

cv::Mat3f paint_concrete_panels(const Colour& colour, Random random) {
  constexpr int kSize = 1024;
  const cv::Mat1f boards = fractal_noise(kSize, {3, 90}, 3, 0.6f, random.part(0));
  const cv::Mat1f broad = fractal_noise(kSize, {5, 5}, 7, 0.6f, random.part(1));
  const cv::Mat1f sand = white_noise(kSize, random.part(2));
  const Paving pores = crazy_paving(kSize, 80, 1.0f, random.part(3));
  const Random of_pore = random.part(4);
  const Random of_panel = random.part(5);
  cv::Mat3f picture(kSize, kSize);
  cv::Mat1f height(kSize, kSize);
  constexpr int kPanel = kSize / 2;
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const int x = column % kPanel;
      const int y = row % kPanel;
      const int number = row / kPanel * 2 + column / kPanel;
      const auto edge = static_cast<float>(std::min({x, y, kPanel - 1 - x, kPanel - 1 - y}));
      const float joint = smooth_step(1.5f, 3.5f, edge);
      const int pore = pores.stone(row, column);
      const bool hole = chance_of(of_pore, pore) < 0.1f;
      const float pit = hole ? 1.0f - smooth_step(0.1f, 0.22f, pores.to_seed(row, column)) : 0.0f;
      // Four holes of formwork ties in each panel.
      const float tie_x = static_cast<float>(std::abs(std::abs(x - kPanel / 2) - 150));
      const float tie_y = static_cast<float>(std::abs(std::abs(y - kPanel / 2) - 150));
      const float tie = 1.0f - smooth_step(7.0f, 9.5f, std::sqrt(tie_x * tie_x + tie_y * tie_y));
      const float shade = 0.88f + 0.24f * chance_of(of_panel, number);
      const float drip =
          1.0f - 0.12f * (1.0f - smooth_step(0.0f, 60.0f, static_cast<float>(y))) * (0.5f + 0.5f * boards(row, column));
      picture(row, column) = colour * shade * drip * (1.0f + 0.07f * broad(row, column)) *
                             (0.9f + 0.2f * sand(row, column)) * (1.0f + 0.03f * boards(row, column)) *
                             (1.0f - 0.5f * pit) * (1.0f - 0.6f * tie) * (0.25f + 0.75f * joint);
      height(row, column) = joint - tie;
    }
  }
  add_relief(picture, height, 6.0f, 0.4f);
  return picture;
}

cv::Mat3f paint_boards(const Colour& colour, int boards, bool upright, Random random) {
  constexpr int kSize = 512;
  const cv::Size long_cells = cv::Size(4, 64);
  const cv::Mat1f grain = fractal_noise(kSize, long_cells, 4, 0.7f, random.part(0));
  const cv::Mat1f waves = fractal_noise(kSize, {3, 12}, 3, 0.5f, random.part(1));
  const cv::Mat1f fibres = fractal_noise(kSize, {8, 256}, 1, 0.5f, random.part(2));
  const Random of_board = random.part(3);
  Random knots_random = random.part(4);
  struct Knot {
    float x, y, radius;
  };
  std::vector<Knot> knots;
  for (int number = 0; number < boards * 2; ++number) {
    const auto x = static_cast<float>(knots_random.uniform(30.0, kSize - 30.0));
    const auto y = static_cast<float>(knots_random.uniform(10.0, kSize - 10.0));
    knots.push_back({x, y, static_cast<float>(knots_random.uniform(2.5, 6.0))});
  }
  const float width = static_cast<float>(kSize) / static_cast<float>(boards);
  cv::Mat3f picture(kSize, kSize);
  cv::Mat1f height(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    const int board = std::min(static_cast<int>(static_cast<float>(row) / width), boards - 1);
    const float y = static_cast<float>(row) - static_cast<float>(board) * width;
    const float shade = 0.75f + 0.5f * chance_of(of_board, board);
    const float tone = chance_of(of_board, board, 1) - 0.5f;
    const Colour own = colour.mul(Colour(1.0f + 0.15f * tone, 1.0f, 1.0f - 0.2f * tone)) * shade;
    for (int column = 0; column < kSize; ++column) {
      float knot = 0.0f;
      float bend = 0.0f;
      for (const Knot& one : knots) {
        const float dx = (static_cast<float>(column) - one.x) / 2.0f;
        const float dy = static_cast<float>(row) - one.y;
        if (std::abs(dx) > 30.0f || std::abs(dy) > 30.0f) continue;
        const float distance = std::sqrt(dx * dx + dy * dy);
        knot = std::max(knot, 1.0f - smooth_step(0.6f * one.radius, one.radius, distance));
        bend += 2.5f * one.radius / (1.0f + distance);
      }
      const float rings = std::sin(0.9f * y + 3.0f * waves(row, column) + bend + 40.0f * chance_of(of_board, board, 2));
      const float figure = 1.0f + 0.10f * rings + 0.10f * grain(row, column) + 0.07f * fibres(row, column);
      const float edge = smooth_step(0.5f, 2.5f, std::min(y, width - y));
      picture(row, column) = own * std::max(figure, 0.2f) * (1.0f - 0.6f * knot) * (0.25f + 0.75f * edge);
      height(row, column) = edge + 0.1f * grain(row, column);
    }
  }
  add_relief(picture, height, 4.0f, 0.3f);
  if (upright) cv::transpose(picture, picture);
  return picture;
}

cv::Mat3f paint_sheet(const Colour& colour, int ribs, Random random) {
  constexpr int kSize = 512;
  const cv::Mat1f streaks = fractal_noise(kSize, {50, 3}, 4, 0.7f, random.part(0));
  const cv::Mat1f broad = fractal_noise(kSize, {5, 5}, 5, 0.6f, random.part(1));
  const cv::Mat1f sand = white_noise(kSize, random.part(2));
  cv::Mat3f picture(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const float phase = std::fmod(static_cast<float>(column * ribs) / kSize, 1.0f);
      // A trapezoid profile: valley, flank in the light, crest, flank in the shade.
      float shade = 0.92f;
      if (phase < 0.08f) shade = 1.25f;
      if (phase >= 0.08f && phase < 0.45f) shade = 1.02f;
      if (phase >= 0.45f && phase < 0.53f) shade = 0.55f;
      if (phase >= 0.53f && phase < 0.6f) shade = 0.78f;
      const bool screw = row % 128 < 4 && std::abs(phase - 0.25f) < 0.02f;
      picture(row, column) = colour * shade * (screw ? 0.5f : 1.0f) * (1.0f + 0.06f * streaks(row, column)) *
                             (1.0f + 0.06f * broad(row, column)) * (0.95f + 0.1f * sand(row, column));
    }
  }
  return picture;
}

cv::Mat3f paint_roof_tiles(const Colour& colour, int rows, int columns, bool slate, Random random) {
  constexpr int kSize = 1024;
  const cv::Mat1f sand = white_noise(kSize, random.part(0));
  const cv::Mat1f moss = fractal_noise(kSize, {6, 6}, 6, 0.65f, random.part(1));
  const cv::Mat1f fine = fractal_noise(kSize, {40, 40}, 4, 0.7f, random.part(2));
  const Random of_tile = random.part(3);
  const float tile_height = static_cast<float>(kSize) / static_cast<float>(rows);
  const float tile_width = static_cast<float>(kSize) / static_cast<float>(columns);
  cv::Mat3f picture(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    const int tile_row = std::min(static_cast<int>(static_cast<float>(row) / tile_height), rows - 1);
    const float y = (static_cast<float>(row) - static_cast<float>(tile_row) * tile_height) / tile_height;
    for (int column = 0; column < kSize; ++column) {
      const float shifted = static_cast<float>(column) + (slate && tile_row % 2 == 1 ? 0.5f * tile_width : 0.0f);
      const int tile_column = static_cast<int>(shifted / tile_width) % columns;
      const float x = std::fmod(shifted, tile_width) / tile_width;
      const int number = tile_row * columns + tile_column;
      const float tone = chance_of(of_tile, number, 1) - 0.5f;
      const Colour own = colour.mul(Colour(1.0f + 0.2f * tone, 1.0f, 1.0f - 0.25f * tone)) *
                         (0.7f + 0.6f * chance_of(of_tile, number)) * (0.86f + 0.28f * sand(row, column)) *
                         (1.0f + 0.1f * fine(row, column));
      float shade = 1.0f;
      // The tile above shadows the top of each tile; the lower edge is bright.
      const float lip = 0.03f * (chance_of(of_tile, number, 2) - 0.5f);
      shade *= 0.35f + 0.65f * smooth_step(0.0f, 0.16f + lip, y);
      if (y > 0.93f) shade *= 1.18f;
      if (slate) {
        shade *= 0.45f + 0.55f * smooth_step(0.0f, 0.03f, std::min(x, 1.0f - x));
      } else {
        // The wave of a pantile: a round crest, and a trough that overlaps the neighbour.
        shade *= 0.62f + 0.45f * std::sin(std::numbers::pi_v<float> * std::min(x / 0.7f, 1.0f)) +
                 0.12f * smooth_step(0.75f, 1.0f, x);
        shade *= 0.5f + 0.5f * smooth_step(0.0f, 0.05f, x);
      }
      const Colour green(0.07f, 0.085f, 0.04f);
      const float grown = 0.6f * smooth_step(1.0f, 2.2f, moss(row, column) + 0.3f * fine(row, column));
      picture(row, column) =
          blended(own, green * (0.6f + 0.8f * sand(row, column)), grown) * shade * (1.0f + 0.06f * moss(row, column));
    }
  }
  return picture;
}

}  // namespace panvo::simulated_world
