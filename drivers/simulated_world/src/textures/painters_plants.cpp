// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "painters.hpp"

namespace panvo::simulated_world {
namespace {

constexpr int kShift = 4;

cv::Point fixed(const cv::Point2f& point) { return {cvRound(point.x * 16.0f), cvRound(point.y * 16.0f)}; }

/// One half (`side` +1, -1) of a leaf's outline, from its stalk at `base` to its tip.
std::vector<cv::Point> half_leaf(cv::Point2f base, float direction_rad, float length, float width, float bend,
                                 float side) {
  const cv::Point2f along(std::cos(direction_rad), std::sin(direction_rad));
  const cv::Point2f across(-along.y, along.x);
  std::vector<cv::Point> outline;
  constexpr int kCorners = 7;
  for (int corner = 0; corner <= kCorners; ++corner) {
    const float t = static_cast<float>(corner) / kCorners;
    const float half =
        0.5f * width * std::pow(std::max(std::sin(std::numbers::pi_v<float> * std::pow(t, 0.8f)), 0.0f), 0.8f);
    const cv::Point2f vein = base + along * (length * t) + across * (bend * t * t);
    outline.push_back(fixed(vein + across * (side * half)));
  }
  for (int corner = kCorners; corner >= 0; --corner) {
    const float t = static_cast<float>(corner) / kCorners;
    outline.push_back(fixed(base + along * (length * t) + across * (bend * t * t)));
  }
  return outline;
}

struct Ink {
  cv::Mat3f& colour;
  cv::Mat1f& alpha;

  void fill(const std::vector<cv::Point>& outline, const Colour& paint) const {
    const std::vector<std::vector<cv::Point>> outlines{outline};
    cv::fillPoly(colour, outlines, cv::Scalar(paint[0], paint[1], paint[2]), cv::LINE_8, kShift);
    cv::fillPoly(alpha, outlines, cv::Scalar(1.0), cv::LINE_8, kShift);
  }
  void line(const cv::Point2f& from, const cv::Point2f& to, const Colour& paint, int width) const {
    cv::line(colour, fixed(from), fixed(to), cv::Scalar(paint[0], paint[1], paint[2]), width, cv::LINE_8, kShift);
    cv::line(alpha, fixed(from), fixed(to), cv::Scalar(1.0), width, cv::LINE_8, kShift);
  }
};

/// Darkens the picture below a leaf, as its shadow.
void shade_below(cv::Mat3f& colour, const std::vector<cv::Point>& outline, float factor) {
  const cv::Rect all(0, 0, colour.cols, colour.rows);
  std::vector<cv::Point> whole;
  for (const cv::Point& corner : outline) whole.emplace_back(corner.x >> kShift, corner.y >> kShift);
  const cv::Rect box = cv::boundingRect(whole) & all;
  if (box.empty()) return;
  cv::Mat1b mask = cv::Mat1b::zeros(box.size());
  for (cv::Point& corner : whole) corner -= box.tl();
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{whole}, cv::Scalar(1));
  for (int row = 0; row < box.height; ++row) {
    for (int column = 0; column < box.width; ++column) {
      if (mask(row, column) != 0) colour(box.y + row, box.x + column) *= factor;
    }
  }
}

using Twig = std::vector<cv::Point2f>;

constexpr int kCardSize = 512;
constexpr int kFineSize = 2 * kCardSize;  // painted at twice the size, then averaged, for soft edges

/// Draws twigs that fan out from the bottom centre of the card and carry the leaves.
std::vector<Twig> draw_twigs(const Ink& ink, bool has_needles, Random random) {
  const cv::Point2f stem(kFineSize * 0.5f, kFineSize * 0.96f);
  const Colour bark(0.075f, 0.055f, 0.035f);
  std::vector<Twig> twigs;
  const int twig_count = has_needles ? 26 : 16;
  for (int twig = 0; twig < twig_count; ++twig) {
    const float spread = (static_cast<float>(twig) + 0.5f) / static_cast<float>(twig_count) - 0.5f;
    const float direction = -0.25f * kTurn + (has_needles ? 2.3f : 3.3f) * spread;
    const auto length = static_cast<float>(random.uniform(0.5, 0.86)) * kFineSize * (1.0f - 0.5f * std::abs(spread));
    const cv::Point2f from = stem + cv::Point2f(0.0f, -static_cast<float>(random.uniform(0.0, 0.5)) * kFineSize);
    auto line = wandering_line(from, direction, length, 24.0f, 0.35f, random.part(twig));
    for (std::size_t corner = 1; corner < line.size(); ++corner) {
      ink.line(line[corner - 1], line[corner], bark, line.size() - corner > 8 ? 5 : 3);
    }
    twigs.push_back(std::move(line));
  }
  return twigs;
}

/// Draws a leaf or needle somewhere on a twig if it fits on the card; `depth` 0..1: later ones lie on top and are
/// brighter.
void draw_leaf(const Ink& ink, const LeafShape& shape, const Twig& twig, float depth, const Colour& colour,
               Random& leaves) {
  const int corner = 1 + leaves.below(static_cast<int>(twig.size()) - 1);
  const cv::Point2f along = twig[corner] - twig[corner - 1];
  const float twig_direction = std::atan2(along.y, along.x);
  const float side = leaves.chance(0.5) ? 1.0f : -1.0f;
  const auto jitter_x = static_cast<float>(leaves.uniform(-14.0, 14.0));
  const cv::Point2f base = twig[corner] + cv::Point2f(jitter_x, static_cast<float>(leaves.uniform(-14.0, 14.0)));
  const auto angle = static_cast<float>(leaves.uniform(0.25, 1.5));
  const auto size = static_cast<float>(leaves.uniform(0.65, 1.25));
  const auto droop = static_cast<float>(leaves.uniform(-0.2, 0.2));
  const auto foreshortened = static_cast<float>(leaves.uniform(0.4, 1.0));
  const auto light = static_cast<float>(leaves.uniform(0.55, 1.45));
  const auto tone = static_cast<float>(leaves.uniform(-1.0, 1.0));
  const float length = shape.length_m * kFineSize * size;
  const float direction = twig_direction + side * (shape.needles > 0 ? 0.5f * angle : angle);
  const cv::Point2f tip = base + cv::Point2f(std::cos(direction), std::sin(direction)) * length;
  constexpr float kInset = 6.0f;
  const cv::Rect2f card(kInset, kInset, kFineSize - 2.0f * kInset, kFineSize - 2.0f * kInset);
  if (!card.contains(tip) || !card.contains(base)) return;
  const Colour own = colour.mul(Colour(1.0f + 0.22f * tone, 1.0f + 0.06f * tone, 1.0f - 0.2f * tone)) * light *
                     (0.45f + 0.65f * depth);
  if (shape.needles > 0) {
    ink.line(base, tip, own, 4);
    return;
  }
  const float width = length * shape.width_share * foreshortened;
  const float bend = droop * length;
  for (const float half : {-1.0f, 1.0f}) {
    const auto shadow = half_leaf(base + cv::Point2f(5.0f, 10.0f), direction, length, width, bend, half);
    shade_below(ink.colour, shadow, 0.6f);
  }
  // The halves of a leaf are lit differently; the pale vein runs between them.
  ink.fill(half_leaf(base, direction, length, width, bend, 1.0f), own * 1.14f);
  ink.fill(half_leaf(base, direction, length, width, bend, -1.0f), own * 0.86f);
  ink.line(base, base + (tip - base) * 0.8f, own * 1.3f, 1);
}

/// Averages over 2 x 2 pixels with the colour of the covered part only; holes get `mean`.
Cutout averaged(const cv::Mat3f& paint, const cv::Mat1f& alpha, const Colour& mean) {
  Cutout result{cv::Mat3f(kCardSize, kCardSize), cv::Mat1f(kCardSize, kCardSize)};
  for (int row = 0; row < kCardSize; ++row) {
    for (int column = 0; column < kCardSize; ++column) {
      Colour sum(0.0f, 0.0f, 0.0f);
      float covered = 0.0f;
      for (const cv::Point& at : {cv::Point(0, 0), cv::Point(1, 0), cv::Point(0, 1), cv::Point(1, 1)}) {
        sum += paint(2 * row + at.y, 2 * column + at.x) * alpha(2 * row + at.y, 2 * column + at.x);
        covered += alpha(2 * row + at.y, 2 * column + at.x);
      }
      result.colour(row, column) = covered > 0.0f ? sum * (1.0f / covered) : mean;
      result.alpha(row, column) = 0.25f * covered;
    }
  }
  return result;
}

}  // namespace

Cutout paint_leaves(const LeafShape& shape, const Colour& colour, Random random) {
  cv::Mat3f paint(kFineSize, kFineSize, Colour(0.0f, 0.0f, 0.0f));
  cv::Mat1f alpha = cv::Mat1f::zeros(kFineSize, kFineSize);
  const Ink ink{paint, alpha};
  const std::vector<Twig> twigs = draw_twigs(ink, shape.needles > 0, random.part(0));
  const int twig_count = static_cast<int>(twigs.size());
  Random leaves = random.part(1);
  const int count = shape.needles > 0 ? shape.needles * twig_count : shape.leaves * 2;
  for (int number = 0; number < count; ++number) {
    const Twig& twig = twigs[leaves.below(twig_count)];
    draw_leaf(ink, shape, twig, static_cast<float>(number) / static_cast<float>(count), colour, leaves);
  }
  return averaged(paint, alpha, colour * 0.8f);
}

cv::Mat3f paint_hedge(const Colour& colour, Random random) {
  constexpr int kSize = 1024;
  const cv::Mat1f depth = fractal_noise(kSize, {14, 14}, 4, 0.6f, random.part(0));
  cv::Mat3f picture(kSize, kSize, Colour(0.008f, 0.011f, 0.005f));
  cv::Mat1f unused = cv::Mat1f::zeros(kSize, kSize);
  const Ink ink{picture, unused};
  Random leaves = random.part(1);
  constexpr int kLeaves = 9000;
  for (int number = 0; number < kLeaves; ++number) {
    const auto x = static_cast<float>(leaves.uniform(0.0, kSize));
    const auto y = static_cast<float>(leaves.uniform(0.0, kSize));
    const auto direction = static_cast<float>(leaves.uniform(0.0, kTurn));
    const auto length = static_cast<float>(leaves.uniform(14.0, 30.0));
    const auto width = length * static_cast<float>(leaves.uniform(0.25, 0.6));
    const auto light = static_cast<float>(leaves.uniform(0.5, 1.5));
    const auto tone = static_cast<float>(leaves.uniform(-1.0, 1.0));
    const float layer = static_cast<float>(number) / kLeaves;
    const float open = depth(static_cast<int>(y), static_cast<int>(x));
    if (layer > 0.75f && open < -0.9f) continue;  // gaps between the shoots stay dark
    const Colour own = colour.mul(Colour(1.0f + 0.25f * tone, 1.0f + 0.05f * tone, 1.0f - 0.2f * tone)) * light *
                       (0.2f + 0.9f * layer) * (1.0f + 0.2f * open);
    const cv::Rect box(static_cast<int>(x) - 32, static_cast<int>(y) - 32, 64, 64);
    for (const cv::Point& offset : tiling_offsets(box, kSize)) {
      const cv::Point2f base = cv::Point2f(x, y) + cv::Point2f(offset);
      shade_below(picture, half_leaf(base + cv::Point2f(2.0f, 4.0f), direction, length, width, 0.0f, 1.0f), 0.75f);
      ink.fill(half_leaf(base, direction, length, width, 0.0f, 1.0f), own * 1.15f);
      ink.fill(half_leaf(base, direction, length, width, 0.0f, -1.0f), own * 0.85f);
    }
  }
  return picture;
}

cv::Mat3f paint_flowers(Random random) {
  cv::Mat3f picture = paint_hedge({0.075f, 0.13f, 0.035f}, random.part(0));
  const int size = picture.cols;
  Random places = random.part(1);
  const Colour petals[] = {
      {0.55f, 0.06f, 0.07f}, {0.62f, 0.48f, 0.06f}, {0.6f, 0.58f, 0.55f}, {0.35f, 0.1f, 0.42f}, {0.6f, 0.2f, 0.3f}};
  for (int flower = 0; flower < 260; ++flower) {
    const cv::Point centre{places.below(size), places.below(size)};  // braces: guaranteed order
    const int kind = places.below(5);
    const Colour petal = varied(petals[kind], 0.25f, 0.1f, random.part(100 + flower));
    const int radius = 7 + places.below(9);
    const auto turn = static_cast<float>(places.uniform(0.0, kTurn));
    const cv::Rect box(centre.x - 30, centre.y - 30, 60, 60);
    for (const cv::Point& offset : tiling_offsets(box, size)) {
      for (int leaf = 0; leaf < 6; ++leaf) {
        const float angle = turn + kTurn * static_cast<float>(leaf) / 6.0f;
        const cv::Point at = centre + offset +
                             cv::Point(cvRound(std::cos(angle) * 0.7f * static_cast<float>(radius)),
                                       cvRound(std::sin(angle) * 0.7f * static_cast<float>(radius)));
        const float shade = 0.75f + 0.4f * static_cast<float>(leaf % 3) / 2.0f;
        cv::circle(picture, at, radius / 2, cv::Scalar(petal[0] * shade, petal[1] * shade, petal[2] * shade),
                   cv::FILLED);
      }
      cv::circle(picture, centre + offset, radius / 4 + 1, cv::Scalar(0.4, 0.25, 0.03), cv::FILLED);
    }
  }
  return picture;
}

cv::Mat3f paint_bark(const Colour& colour, Random random) {
  constexpr int kSize = 512;
  const cv::Mat1f bend_x = 7.0f * fractal_noise(kSize, {5, 7}, 3, 0.5f, random.part(0));
  const cv::Mat1f bend_y = 10.0f * fractal_noise(kSize, {9, 5}, 2, 0.5f, random.part(4));
  // Long upright cork plates between furrows: a compressed paving.
  const Paving plates = crazy_paving(kSize, 12, 0.9f, random.part(1));
  cv::Mat1f tall;
  cv::resize(plates.to_edge, tall, {kSize / 2, kSize}, 0.0, 0.0, cv::INTER_AREA);
  tall = cv::repeat(tall, 1, 2);
  const cv::Mat1f fibres = fractal_noise(kSize, {70, 10}, 3, 0.7f, random.part(5));
  const cv::Mat1f ridges = displaced(tall, bend_x, bend_y);
  const cv::Mat1f broad = fractal_noise(kSize, {5, 5}, 5, 0.6f, random.part(2));
  const cv::Mat1f sand = white_noise(kSize, random.part(3));
  cv::Mat3f picture(kSize, kSize);
  cv::Mat1f height(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const float ridge = smooth_step(0.0f, 0.24f, ridges(row, column) + 0.05f * fibres(row, column));
      const float lichen = 0.4f * smooth_step(1.0f, 2.0f, broad(row, column));
      const Colour wood = colour * (0.45f + 0.75f * ridge) * (0.8f + 0.4f * sand(row, column)) *
                          (1.0f + 0.1f * broad(row, column) + 0.15f * fibres(row, column));
      picture(row, column) = wood + (Colour(0.14f, 0.16f, 0.1f) * (0.4f + 0.6f * ridge) - wood) * lichen;
      height(row, column) = ridge;
    }
  }
  add_relief(picture, height, 5.0f, 0.6f);
  return picture;
}

}  // namespace panvo::simulated_world
