// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "painters.hpp"

namespace panvo::simulated_world {

cv::Mat3f paint_asphalt(float mm_per_px, const Colour& stone, const Colour& binder, float contrast, Random random) {
  constexpr int kSize = 1024;
  const float width_mm = mm_per_px * kSize;
  // Chippings of two sizes in the binder; their visibility varies over decimetres with the wear of the road.
  const Paving large = crazy_paving(kSize, static_cast<int>(width_mm / 15.0f), 0.95f, random.part(0));
  const Paving small = crazy_paving(kSize, static_cast<int>(width_mm / 7.0f), 0.95f, random.part(1));
  const cv::Mat1f wear = fractal_noise(kSize, {9, 9}, 4, 0.8f, random.part(2));
  const cv::Mat1f sand = white_noise(kSize, random.part(3));
  const cv::Mat1f blotch = fractal_noise(kSize, {14, 14}, 5, 0.7f, random.part(4));
  const Random of_large = random.part(5);
  const Random of_small = random.part(6);
  cv::Mat3f picture(kSize, kSize);
  cv::Mat1f height(kSize, kSize);
  const auto chipping = [&](const Paving& paving, const Random& chances, int row, int column, float share,
                            float& brightness) {
    const int number = paving.stone(row, column);
    const float luck = chance_of(chances, number);
    const float exposed = share + 0.10f * wear(row, column);
    if (luck > exposed) return 0.0f;
    const float shade = chance_of(chances, number, 1);
    // Most chippings are grey, a few are pale quartz or black basalt.
    brightness = shade > 0.93f ? 1.35f + 9.0f * (shade - 0.93f) : 0.5f + 0.95f * shade;
    brightness *= 1.15f - 0.35f * paving.to_seed(row, column);
    return smooth_step(0.0f, 0.26f, paving.to_edge(row, column));
  };
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const float grain = 0.7f + 0.6f * sand(row, column);
      float of_pale = 0.0f;
      Colour colour = binder * grain;
      float brightness = 1.0f;
      const float fine = chipping(small, of_small, row, column, 0.55f, brightness);
      colour += (stone * (1.0f + contrast * (brightness - 1.0f)) * (0.85f + 0.3f * sand(row, column)) - colour) * fine;
      of_pale = 0.6f * fine;
      const float coarse = chipping(large, of_large, row, column, 0.42f, brightness);
      const Colour warm = stone.mul(Colour(1.04f, 1.0f, 0.95f));
      colour +=
          (warm * (1.0f + contrast * (brightness - 1.0f)) * (0.88f + 0.24f * sand(row, column)) - colour) * coarse;
      of_pale = std::max(of_pale, coarse);
      picture(row, column) = colour * (1.0f + 0.07f * blotch(row, column));
      height(row, column) = of_pale;
    }
  }
  add_relief(picture, height, 14.0f / mm_per_px, 0.5f * contrast);
  flatten(picture, 1.0f);
  return picture;
}

cv::Mat3f paint_concrete(const Colour& colour, float grain, Random random) {
  constexpr int kSize = 512;
  const cv::Mat1f broad = fractal_noise(kSize, {4, 4}, 6, 0.6f, random.part(0));
  const cv::Mat1f sand = blurred(white_noise(kSize, random.part(1)), 0.6);
  const Paving pores = crazy_paving(kSize, 70, 1.0f, random.part(2));
  const Random of_pores = random.part(3);
  cv::Mat3f picture(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const int number = pores.stone(row, column);
      const bool is_pore = chance_of(of_pores, number) < 0.12f;
      const float radius = 0.08f + 0.2f * chance_of(of_pores, number, 1);
      const float pore = is_pore ? 1.0f - smooth_step(0.6f * radius, radius, pores.to_seed(row, column)) : 0.0f;
      const float stone = 1.0f + 0.14f * grain * (chance_of(of_pores, number, 2) - 0.5f);
      picture(row, column) = colour * stone * (1.0f + 0.08f * broad(row, column)) *
                             (1.0f + grain * 1.1f * (sand(row, column) - 0.5f)) * (1.0f - 0.55f * pore);
    }
  }
  flatten(picture, 0.9f);
  return picture;
}

cv::Mat3f paint_slabs(int rows, int columns, bool staggered, const Colour& colour, Random random) {
  constexpr int kSize = 1024;
  const cv::Mat1f broad = fractal_noise(kSize, {6, 6}, 6, 0.65f, random.part(0));
  const cv::Mat1f sand = white_noise(kSize, random.part(1));
  const cv::Mat1f wobble = fractal_noise(kSize, {40, 40}, 3, 0.6f, random.part(2));
  const Random of_slab = random.part(3);
  const float slab_height = static_cast<float>(kSize) / static_cast<float>(rows);
  const float slab_width = static_cast<float>(kSize) / static_cast<float>(columns);
  cv::Mat3f picture(kSize, kSize);
  cv::Mat1f height(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    const int slab_row = static_cast<int>(static_cast<float>(row) / slab_height);
    const float y = static_cast<float>(row) - static_cast<float>(slab_row) * slab_height;
    for (int column = 0; column < kSize; ++column) {
      const float shifted = static_cast<float>(column) + (staggered && slab_row % 2 == 1 ? 0.5f * slab_width : 0.0f);
      const int slab_column = static_cast<int>(shifted / slab_width) % columns;
      const float x = std::fmod(shifted, slab_width);
      const int number = slab_row * columns + slab_column;
      const float edge = std::min({x, y, slab_width - x, slab_height - y}) + 0.7f * wobble(row, column) +
                         1.2f * (chance_of(of_slab, number, 4) - 0.5f);
      const float face = smooth_step(2.0f, 4.5f, edge);
      const float shade = 0.8f + 0.4f * chance_of(of_slab, number);
      const Colour own = colour.mul(Colour(1.0f + 0.06f * (chance_of(of_slab, number, 1) - 0.5f), 1.0f,
                                           1.0f - 0.1f * (chance_of(of_slab, number, 1) - 0.5f)));
      const float speckle = sand(row, column) > 0.93f ? 0.7f : 1.0f;
      const Colour stone =
          own * shade * speckle * (1.0f + 0.07f * broad(row, column)) * (0.86f + 0.28f * sand(row, column));
      const Colour joint = Colour(0.055f, 0.05f, 0.042f) * (0.6f + 0.8f * sand(row, column));
      picture(row, column) = joint + (stone - joint) * face;
      height(row, column) = face + 0.25f * smooth_step(4.0f, 14.0f, edge) + 0.3f * chance_of(of_slab, number, 2);
    }
  }
  add_relief(picture, height, 8.0f, 0.35f);
  return picture;
}

cv::Mat3f paint_cobbles(int cells, const Colour& colour, Random random) {
  constexpr int kSize = 1024;
  const Paving paving = crazy_paving(kSize, cells, 0.42f, random.part(0));
  const cv::Mat1f sand = white_noise(kSize, random.part(1));
  const cv::Mat1f broad = fractal_noise(kSize, {16, 16}, 5, 0.7f, random.part(2));
  const Random of_stone = random.part(3);
  cv::Mat3f picture(kSize, kSize);
  cv::Mat1f height(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const int number = paving.stone(row, column);
      const float edge = paving.to_edge(row, column) + 0.015f * broad(row, column);
      const float dome = smooth_step(0.03f, 0.3f, edge);
      const float tone = chance_of(of_stone, number, 1) - 0.5f;
      const Colour own = colour.mul(Colour(1.0f + 0.2f * tone, 1.0f, 1.0f - 0.18f * tone)) *
                         (0.6f + 0.8f * chance_of(of_stone, number));
      const Colour stone =
          own * (0.75f + 0.3f * dome) * (0.8f + 0.4f * sand(row, column)) * (1.0f + 0.08f * broad(row, column));
      const Colour joint = Colour(0.06f, 0.052f, 0.04f) * (0.5f + sand(row, column));
      picture(row, column) = joint + (stone - joint) * smooth_step(0.04f, 0.1f, edge);
      height(row, column) = dome;
    }
  }
  add_relief(picture, height, 10.0f, 0.5f);
  flatten(picture, 0.7f);
  return picture;
}

cv::Mat3f paint_gravel(int cells, const Colour& colour, Random random) {
  constexpr int kSize = 1024;
  const Paving stones = crazy_paving(kSize, cells, 1.0f, random.part(0));
  const Paving pebbles = crazy_paving(kSize, cells * 5 / 2, 1.0f, random.part(1));
  const cv::Mat1f sand = white_noise(kSize, random.part(2));
  const cv::Mat1f broad = fractal_noise(kSize, {5, 5}, 5, 0.6f, random.part(3));
  const Random of_stone = random.part(4);
  const Random of_pebble = random.part(5);
  cv::Mat3f picture(kSize, kSize);
  cv::Mat1f height(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const auto one = [&](const Paving& paving, const Random& chances, float& dome) {
        const int number = paving.stone(row, column);
        dome = smooth_step(0.02f, 0.35f, paving.to_edge(row, column));
        const float tone = chance_of(chances, number, 1) - 0.5f;
        return Colour(1.0f + 0.25f * tone, 1.0f, 1.0f - 0.22f * tone) * (0.45f + 1.1f * chance_of(chances, number)) *
               (0.45f + 0.65f * dome);
      };
      float fine_dome = 0.0f;
      float dome = 0.0f;
      const Colour fine = one(pebbles, of_pebble, fine_dome) * 0.8f;
      const Colour coarse = one(stones, of_stone, dome);
      const bool there = chance_of(of_stone, stones.stone(row, column), 2) < 0.55f;
      const float share = there ? smooth_step(0.05f, 0.12f, stones.to_edge(row, column)) : 0.0f;
      picture(row, column) = colour.mul(fine + (coarse - fine) * share) * (0.85f + 0.3f * sand(row, column)) *
                             (1.0f + 0.09f * broad(row, column));
      height(row, column) = there ? 0.4f + dome : 0.4f * fine_dome;
    }
  }
  add_relief(picture, height, 9.0f, 0.5f);
  flatten(picture, 0.9f);
  return picture;
}

cv::Mat3f paint_grass(Random random) {
  constexpr int kSize = 1024;
  const cv::Mat1f clumps = fractal_noise(kSize, {9, 9}, 5, 0.65f, random.part(0));
  const cv::Mat1f dry = fractal_noise(kSize, {4, 4}, 5, 0.6f, random.part(1));
  const cv::Mat1f bare = fractal_noise(kSize, {11, 11}, 5, 0.7f, random.part(2));
  const cv::Mat1f sand = white_noise(kSize, random.part(3));
  cv::Mat3f picture(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const float earth = smooth_step(2.0f, 2.8f, bare(row, column));
      const Colour thatch = Colour(0.035f, 0.045f, 0.014f) * (0.5f + sand(row, column));
      const Colour soil = Colour(0.10f, 0.075f, 0.048f) * (0.6f + 0.8f * sand(row, column));
      picture(row, column) = thatch + (soil - thatch) * earth;
    }
  }
  // Blades, from dark ones at the bottom to bright ones on top.
  Random blades = random.part(4);
  constexpr int kBlades = 60000;
  constexpr int kShift = 3;
  for (int number = 0; number < kBlades; ++number) {
    const cv::Point2f root = somewhere(kSize, blades);
    const int row = static_cast<int>(root.y) % kSize;
    const int column = static_cast<int>(root.x) % kSize;
    const auto luck = static_cast<float>(blades.uniform());
    const auto direction = static_cast<float>(blades.uniform(0.0, kTurn));
    const auto length = static_cast<float>(blades.uniform(5.0, 19.0));
    const auto shade = static_cast<float>(blades.uniform(0.65, 1.35));
    const auto yellow = static_cast<float>(blades.uniform());
    const float density = 1.0f - 0.93f * smooth_step(1.8f, 2.6f, bare(row, column));
    if (luck > density * (0.75f + 0.25f * clumps(row, column))) continue;
    const float layer = static_cast<float>(number) / kBlades;
    const float straw = yellow < 0.06f ? 1.0f : std::clamp(0.25f * dry(row, column) + 0.15f, 0.0f, 0.7f);
    const Colour green(0.085f, 0.135f, 0.032f);
    const Colour yellowed(0.21f, 0.18f, 0.075f);
    Colour colour =
        (green + (yellowed - green) * straw) * shade * (0.45f + 0.75f * layer) * (1.0f + 0.18f * clumps(row, column));
    const cv::Point2f tip = root + cv::Point2f(std::cos(direction), std::sin(direction)) * length;
    const cv::Scalar ink(colour[0], colour[1], colour[2]);
    const int thickness = blades.chance(0.35) ? 2 : 1;
    const cv::Rect box(column - 20, row - 20, 40, 40);
    for (const cv::Point& offset : tiling_offsets(box, kSize)) {
      const cv::Point2f shifted(offset);
      cv::line(picture, (root + shifted) * 8.0f, (tip + shifted) * 8.0f, ink, thickness, cv::LINE_8, kShift);
    }
  }
  flatten(picture, 1.0f);
  return picture;
}

cv::Mat3f paint_soil(Random random) {
  cv::Mat3f picture = paint_gravel(90, {0.10f, 0.072f, 0.047f}, random.part(0));
  const cv::Mat1f lumps = fractal_noise(picture.cols, {14, 14}, 6, 0.7f, random.part(1));
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      const Colour earth = Colour(0.095f, 0.068f, 0.045f) * (1.0f + 0.25f * lumps(row, column));
      picture(row, column) = 0.45f * picture(row, column) + 0.55f * earth;
    }
  }
  add_relief(picture, lumps, 8.0f, 0.4f);
  flatten(picture, 0.8f);
  return picture;
}

cv::Mat3f paint_marking(Random random) {
  constexpr int kSize = 1024;
  const cv::Mat3f road = paint_asphalt(2.4f, {0.15f, 0.148f, 0.142f}, {0.05f, 0.05f, 0.05f}, 0.8f, random.part(0));
  const cv::Mat1f flakes = fractal_noise(kSize, {20, 20}, 6, 0.8f, random.part(1));
  const cv::Mat1f areas = fractal_noise(kSize, {4, 4}, 4, 0.6f, random.part(2));
  const cv::Mat1f sand = white_noise(kSize, random.part(3));
  cv::Mat3f picture(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const float tip = 3.5f * (road(row, column)[1] - 0.11f);
      const float worn = smooth_step(1.5f, 1.9f, flakes(row, column) + 0.4f * areas(row, column) + tip);
      const float dirt = 1.0f - 0.12f * smooth_step(-0.5f, 2.0f, areas(row, column)) - 0.08f * flakes(row, column);
      // The road's grain is visible through the thin paint as shading.
      const float grain = 0.75f + 1.6f * road(row, column)[1];
      const Colour paint =
          Colour(0.62f, 0.61f, 0.57f) * dirt * std::min(grain, 1.15f) * (0.93f + 0.14f * sand(row, column));
      picture(row, column) = paint + (road(row, column) - paint) * worn;
    }
  }
  return picture;
}

cv::Mat3f paint_manhole(Random random) {
  constexpr int kSize = 512;
  const cv::Mat1f rust = fractal_noise(kSize, {6, 6}, 6, 0.65f, random.part(0));
  const cv::Mat1f sand = white_noise(kSize, random.part(1));
  cv::Mat1f height = cv::Mat1f::zeros(kSize, kSize);
  // The lid is centred, with its rim at the picture's borders: rings and a field of studs.
  const cv::Point2f centre(255.5f, 255.5f);
  cv::circle(height, centre, 250, 1.0, 10);
  cv::circle(height, centre, 226, 1.0, 6);
  cv::circle(height, centre, 130, 1.0, 8);
  for (int row = 0; row < 32; ++row) {
    for (int column = 0; column < 32; ++column) {
      const cv::Point2f at(8.0f + 16.0f * static_cast<float>(column), 8.0f + 16.0f * static_cast<float>(row));
      const double radius = cv::norm(at - centre);
      if (radius > 214.0 || std::abs(radius - 130.0) < 12.0) continue;
      if ((row + column) % 2 == 0) {
        cv::rectangle(height, cv::Rect(cv::Point(at) - cv::Point(5, 3), cv::Size(10, 6)), 0.9, cv::FILLED);
      } else {
        cv::rectangle(height, cv::Rect(cv::Point(at) - cv::Point(3, 5), cv::Size(6, 10)), 0.9, cv::FILLED);
      }
    }
  }
  for (const float angle : {0.7f, 0.7f + 0.5f * kTurn}) {
    const cv::Point2f hole = centre + cv::Point2f(std::cos(angle), std::sin(angle)) * 175.0f;
    cv::circle(height, hole, 14, -1.2, cv::FILLED);
  }
  const cv::Mat1f soft = blurred(height, 1.2);
  cv::Mat3f picture(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const float brown = smooth_step(-0.5f, 1.5f, rust(row, column));
      const Colour iron =
          Colour(0.085f, 0.084f, 0.083f) + (Colour(0.10f, 0.072f, 0.05f) - Colour(0.085f, 0.084f, 0.083f)) * brown;
      picture(row, column) =
          iron * (0.55f + 0.95f * std::max(soft(row, column), -0.4f)) * (0.8f + 0.4f * sand(row, column));
    }
  }
  add_relief(picture, soft, 5.0f, 0.5f);
  return picture;
}

cv::Mat3f paint_far_land(Random random) {
  constexpr int kSize = 512;
  const cv::Mat1f broad = fractal_noise(kSize, {5, 5}, 7, 0.65f, random.part(0));
  const cv::Mat1f dry = fractal_noise(kSize, {4, 4}, 5, 0.6f, random.part(1));
  const Paving fields = crazy_paving(kSize, 5, 0.7f, random.part(2));
  const cv::Mat1f woods = fractal_noise(kSize, {4, 4}, 7, 0.6f, random.part(5));
  const cv::Mat1f sand = white_noise(kSize, random.part(3));
  const Random of_field = random.part(4);
  cv::Mat3f picture(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const int field = fields.stone(row, column);
      const float straw = std::clamp(0.8f * chance_of(of_field, field) - 0.2f + 0.2f * dry(row, column), 0.0f, 1.0f);
      const Colour green(0.075f, 0.115f, 0.035f);
      const Colour yellow(0.19f, 0.17f, 0.08f);
      const float hedge = 1.0f - 0.5f * (1.0f - smooth_step(0.01f, 0.03f, fields.to_edge(row, column)));
      const Colour meadow = (green + (yellow - green) * straw) * hedge;
      const float wooded = smooth_step(0.1f, 0.25f, woods(row, column));
      const Colour wood = Colour(0.035f, 0.058f, 0.022f) * (0.4f + 1.2f * sand(row, column));
      picture(row, column) = (meadow * (0.75f + 0.5f * sand(row, column)) + (wood - meadow) * wooded) *
                             (1.0f + 0.12f * broad(row, column));
    }
  }
  return picture;
}

}  // namespace panvo::simulated_world
