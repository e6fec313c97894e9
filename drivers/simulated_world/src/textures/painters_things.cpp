// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>

#include "painters.hpp"

namespace panvo::simulated_world {
namespace {

constexpr int kSize = 256;

cv::Scalar ink(const Colour& colour) { return {colour[0], colour[1], colour[2]}; }

/// Weathers a painted surface: blotches, rain streaks, grain.
void weather(cv::Mat3f& picture, float strength, Random random) {
  const cv::Mat1f broad = fractal_noise(picture.cols, {4, 4}, 5, 0.6f, random.part(0));
  const cv::Mat1f rain = fractal_noise(picture.cols, {40, 3}, 3, 0.6f, random.part(1));
  const cv::Mat1f sand = white_noise(picture.cols, random.part(2));
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      picture(row, column) *=
          1.0f + strength * (0.6f * broad(row, column) - 0.7f * smooth_step(0.3f, 2.0f, rain(row, column)) +
                             0.5f * (sand(row, column) - 0.5f));
    }
  }
}

}  // namespace

cv::Mat3f paint_plain(const Colour& colour, float blotches, float grain, Random random) {
  const cv::Mat1f broad = fractal_noise(kSize, {5, 5}, 5, 0.6f, random.part(0));
  const cv::Mat1f sand = white_noise(kSize, random.part(1));
  cv::Mat3f picture(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      picture(row, column) =
          colour * (1.0f + blotches * broad(row, column) + 2.0f * grain * (sand(row, column) - 0.5f));
    }
  }
  return picture;
}

cv::Mat3f paint_glass(Random random) {
  // Behind a pane by day: a dark room, slightly brighter near the sill and at pale objects.
  const cv::Mat1f room = fractal_noise(kSize, {3, 2}, 3, 0.5f, random.part(0));
  const cv::Mat1f dust = fractal_noise(kSize, {8, 8}, 5, 0.7f, random.part(1));
  cv::Mat3f picture(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    const float down = 0.5f - 0.5f * std::cos(2.0f * std::numbers::pi_v<float> * static_cast<float>(row) / kSize);
    for (int column = 0; column < kSize; ++column) {
      const float shade = 0.6f + 0.6f * down + 0.3f * room(row, column) + 0.06f * dust(row, column);
      picture(row, column) = Colour(0.020f, 0.023f, 0.025f) * std::max(shade, 0.2f);
    }
  }
  return picture;
}

cv::Mat3f paint_curtain(const Colour& colour, Random random) {
  const cv::Mat1f folds = fractal_noise(kSize, {14, 1}, 3, 0.5f, random.part(0));
  const cv::Mat1f weave = white_noise(kSize, random.part(1));
  cv::Mat3f picture(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      picture(row, column) =
          colour * std::max(0.85f + 0.25f * folds(row, column), 0.3f) * (0.95f + 0.1f * weave(row, column));
    }
  }
  return picture;
}

cv::Mat3f paint_door(const Colour& colour, Random random) {
  cv::Mat3f wood = paint_boards(colour, 6, true, random.part(0));
  cv::Mat1f height = cv::Mat1f::zeros(wood.size());
  const int size = wood.cols;
  // Four recessed panels with a bead around each.
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 2; ++column) {
      const cv::Rect panel(column * size / 2 + size / 14, row * size / 2 + size / 14, size / 2 - size / 7,
                           size / 2 - size / 7);
      cv::rectangle(height, panel, -1.0, cv::FILLED);
      const cv::Rect inner(panel.x + 26, panel.y + 26, panel.width - 52, panel.height - 52);
      cv::rectangle(height, inner, -0.2, cv::FILLED);
    }
  }
  const cv::Mat1f soft = blurred(height, 2.0);
  add_relief(wood, soft, 6.0f, 2.2f);
  return wood;
}

cv::Mat3f paint_shutter(const Colour& colour, Random random) {
  cv::Mat3f picture = paint_plain(colour, 0.05f, 0.06f, random.part(0));
  constexpr int kSlats = 16;
  for (int row = 0; row < kSize; ++row) {
    const float phase = std::fmod(static_cast<float>(row * kSlats) / kSize, 1.0f);
    const float shade = 0.35f + 0.8f * smooth_step(0.0f, 0.35f, phase) - 0.15f * smooth_step(0.75f, 1.0f, phase);
    for (int column = 0; column < kSize; ++column) picture(row, column) *= shade;
  }
  weather(picture, 0.12f, random.part(1));
  return picture;
}

cv::Mat3f paint_sign(const Colour& face, const Colour& border, Random random) {
  cv::Mat3f picture(kSize, kSize, border);
  const cv::Point centre(kSize / 2, kSize / 2);
  cv::rectangle(picture, cv::Rect(12, 12, kSize - 24, kSize - 24), ink(face), cv::FILLED);
  const Colour light(0.62f, 0.62f, 0.6f);
  const bool pale = face[1] > 0.3f;
  const Colour figure = pale ? Colour(0.03f, 0.03f, 0.035f) : light;
  switch (random.part(0).below(3)) {
    case 0:  // an arrow upwards
      cv::rectangle(picture, cv::Rect(centre.x - 14, 110, 28, 100), ink(figure), cv::FILLED);
      cv::fillPoly(picture,
                   std::vector<std::vector<cv::Point>>{{{centre.x, 45}, {centre.x + 52, 120}, {centre.x - 52, 120}}},
                   ink(figure), cv::LINE_AA);
      break;
    case 1:  // a bar
      cv::rectangle(picture, cv::Rect(45, centre.y - 24, kSize - 90, 48), ink(figure), cv::FILLED);
      break;
    default:  // a letter
      cv::putText(picture, "P", {68, 205}, cv::FONT_HERSHEY_DUPLEX, 6.2, ink(figure), 22, cv::LINE_AA);
  }
  weather(picture, 0.08f, random.part(1));
  return picture;
}

cv::Mat3f paint_poster(Random random) {
  constexpr int kPoster = 512;
  constexpr int kSheets = 2;  // 2 x 2 different sheets over the period
  static const std::array<std::string, 12> kWords{"JAZZ",   "OPEN DAY", "LECTURE", "SPRING", "CINEMA",  "CHOIR",
                                                  "MARKET", "THEATRE",  "ROBOTS",  "RUN 10", "LIBRARY", "GALLERY"};
  cv::Mat3f picture(kPoster, kPoster, Colour(0.3f, 0.3f, 0.28f));
  for (int number = 0; number < kSheets * kSheets; ++number) {
    Random sheet = random.part(number);
    const int size = kPoster / kSheets;
    cv::Mat3f page = picture(cv::Rect(number % kSheets * size + 5, number / kSheets * size + 5, size - 10, size - 10));
    const auto vivid = [&sheet] {
      const auto hue = static_cast<float>(sheet.uniform(0.0, 2.0 * std::numbers::pi));
      const auto light = static_cast<float>(sheet.uniform(0.05, 0.30));
      return Colour(light * (1.0f + 0.6f * std::cos(hue)), light * (1.0f + 0.6f * std::cos(hue - 2.09f)),
                    light * (1.0f + 0.6f * std::cos(hue + 2.09f)));
    };
    const Colour ground = sheet.chance(0.5) ? Colour(0.62f, 0.6f, 0.55f) : vivid();
    page.setTo(ink(ground));
    for (int shape = 0; shape < 7; ++shape) {
      const cv::Point at{sheet.below(page.cols), 50 + sheet.below(page.rows)};
      const int extent = 15 + sheet.below(55);
      if (sheet.chance(0.5)) {
        cv::circle(page, at, extent, ink(vivid()), cv::FILLED, cv::LINE_AA);
      } else {
        cv::rectangle(page, cv::Rect(at.x, at.y, extent * 2, extent), ink(vivid()), cv::FILLED);
      }
    }
    const bool dark_letters = ground[1] > 0.25f;
    const cv::Scalar letters = dark_letters ? ink({0.03f, 0.03f, 0.04f}) : ink({0.62f, 0.61f, 0.58f});
    const std::string& word = kWords[sheet.below(static_cast<int>(kWords.size()))];
    int baseline = 0;
    const int natural = cv::getTextSize(word, cv::FONT_HERSHEY_DUPLEX, 1.0, 3, &baseline).width;
    cv::putText(page, word, {12, 48}, cv::FONT_HERSHEY_DUPLEX, std::min(1.9, (page.cols - 24.0) / natural), letters, 4,
                cv::LINE_AA);
    for (int line = 0; line < 6; ++line) {
      const int width = 40 + sheet.below(page.cols - 80);
      cv::rectangle(page, cv::Rect(14, page.rows - 14 - 11 * line, width, 4), letters, cv::FILLED);
    }
  }
  weather(picture, 0.07f, random.part(99));
  return picture;
}

cv::Mat3f paint_plate(Random random) {
  cv::Mat3f picture(kSize, kSize, Colour(0.6f, 0.6f, 0.58f));
  // Rows of plates, so that any part of the period shows letters.
  constexpr int kRow = 64;
  for (int row = 0; row < kSize / kRow; ++row) {
    Random letters = random.part(row);
    std::string text;
    for (int place = 0; place < 7; ++place) {
      if (place == 3) text += ' ';
      text += place < 3 ? static_cast<char>('A' + letters.below(26)) : static_cast<char>('0' + letters.below(10));
    }
    cv::putText(picture, text, {22, row * kRow + 50}, cv::FONT_HERSHEY_DUPLEX, 1.4, ink({0.02f, 0.02f, 0.025f}), 3,
                cv::LINE_AA);
    cv::rectangle(picture, cv::Rect(0, row * kRow, 18, kRow), ink({0.02f, 0.05f, 0.3f}), cv::FILLED);
    cv::rectangle(picture, cv::Rect(0, row * kRow, kSize, kRow), ink({0.03f, 0.03f, 0.03f}), 2);
  }
  weather(picture, 0.04f, random.part(99));
  return picture;
}

cv::Mat3f paint_tyre(Random random) {
  cv::Mat3f picture = paint_plain({0.022f, 0.022f, 0.023f}, 0.1f, 0.1f, random);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const int block = (column + (row / 32 % 2) * 16) % 32;
      if (block < 4 || row % 32 < 4) picture(row, column) *= 0.45f;
    }
  }
  return picture;
}

cv::Mat3f paint_cloth(const Colour& colour, int threads, Random random) {
  const cv::Mat1f folds = fractal_noise(kSize, {4, 3}, 4, 0.5f, random.part(0));
  const cv::Mat1f sand = white_noise(kSize, random.part(1));
  cv::Mat3f picture(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const bool weft = (row * threads / kSize + column * threads / kSize) % 2 == 0;
      picture(row, column) =
          colour * (1.0f + 0.16f * folds(row, column)) * (weft ? 1.08f : 0.92f) * (0.9f + 0.2f * sand(row, column));
    }
  }
  return picture;
}

cv::Mat3f paint_hair(Random random) {
  const cv::Mat1f strands = fractal_noise(kSize, {90, 4}, 3, 0.7f, random.part(0));
  cv::Mat3f picture(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      picture(row, column) = Colour(0.05f, 0.035f, 0.024f) * std::max(1.0f + 0.4f * strands(row, column), 0.15f);
    }
  }
  return picture;
}

}  // namespace panvo::simulated_world
