// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/texture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "panvo/simulated_world/random.hpp"

namespace panvo::simulated_world {
namespace {

using Uv = Eigen::Vector2f;

constexpr float kLinearOf128 = 0.2158605f;  // IEC 61966-2-1

cv::Mat grey_picture(int size, auto&& value_at) {
  cv::Mat4b picture(size, size);
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const auto value = static_cast<std::uint8_t>(value_at(row, column));
      picture(row, column) = {value, value, value, 255};
    }
  }
  return picture;
}

TEST(Texture, OfOneColourHasItsLinearValueAtEveryFootprint) {
  const Texture texture(cv::Mat(64, 32, CV_8UC4, cv::Scalar(128, 255, 0, 255)));
  EXPECT_EQ(texture.width(), 32);
  EXPECT_EQ(texture.height(), 64);
  EXPECT_NEAR(texture.mean().x(), kLinearOf128, 1e-3);
  for (const float step : {1e-4f, 0.01f, 0.3f, 5.0f}) {
    const Eigen::Vector4f seen = texture.sample({0.37f, -1.92f}, {step, 0.0f}, {0.0f, 3.0f * step}, 4);
    EXPECT_NEAR(seen.x(), kLinearOf128, 2e-3) << step;
    EXPECT_NEAR(seen.y(), 1.0, 2e-3) << step;
    EXPECT_NEAR(seen.z(), 0.0, 2e-3) << step;
    EXPECT_NEAR(seen.w(), 1.0, 2e-3) << step;
  }
}

TEST(Texture, ShowsATexelAtItsCentreAndBlendsBetweenTwo) {
  const Texture texture(grey_picture(4, [](int row, int column) { return row == 1 && column == 2 ? 255 : 0; }));
  const Uv centre(2.5f / 4.0f, 1.5f / 4.0f);
  const Uv none = Uv::Zero();
  EXPECT_NEAR(texture.sample(centre, none, none, 1).x(), 1.0, 1e-3);
  EXPECT_NEAR(texture.sample(centre + Uv(0.125f, 0.0f), none, none, 1).x(), 0.5, 1e-3);
  EXPECT_NEAR(texture.sample(centre + Uv(0.125f, 0.125f), none, none, 1).x(), 0.25, 1e-3);
  EXPECT_NEAR(texture.sample(centre + Uv(0.25f, 0.0f), none, none, 1).x(), 0.0, 1e-3);
}

TEST(Texture, RepeatsAfterEachPeriod) {
  Random random(3, "texture");
  const Texture texture(grey_picture(16, [&](int, int) { return random.below(256); }));
  for (int trial = 0; trial < 100; ++trial) {
    // Sixteenths of texels, so that the shifted positions are exact floats.
    const Uv uv(static_cast<float>(random.below(256)) / 256.0f, static_cast<float>(random.below(256)) / 256.0f);
    const Uv step(0.05f, 0.0f);
    const Uv other_step(0.0f, 0.08f);
    const Eigen::Vector4f here = texture.sample(uv, step, other_step, 2);
    EXPECT_LT((texture.sample(uv + Uv(3.0f, -5.0f), step, other_step, 2) - here).norm(), 1e-4);
  }
}

TEST(Texture, AveragesLightAndNotItsEncoding) {
  const Texture texture(grey_picture(64, [](int row, int column) { return (row + column) % 2 == 0 ? 255 : 0; }));
  const Eigen::Vector4f seen = texture.sample({0.2f, 0.7f}, {4.0f / 64.0f, 0.0f}, {0.0f, 4.0f / 64.0f}, 1);
  EXPECT_NEAR(seen.x(), 0.5, 5e-3);
  EXPECT_NEAR(texture.mean().x(), 0.5, 1e-3);
}

/// Remaining contrast of stripes seen with a footprint elongated along them.
float contrast_of_stripes(bool diagonal, int taps) {
  const Texture texture(grey_picture(
      128, [=](int row, int column) { return (diagonal ? row + column : column) / 8 % 2 == 0 ? 255 : 0; }));
  const Uv long_axis = (diagonal ? Uv(1.0f, -1.0f) : Uv(0.0f, 1.4142f)) * (8.0f / 128.0f);
  const Uv short_axis = (diagonal ? Uv(0.7f, 0.7f) : Uv(1.0f, 0.0f)) * (1.0f / 128.0f);
  const auto at = [&](float column) {
    const Uv uv = diagonal ? Uv(column, 0.5f) / 128.0f : Uv(column / 128.0f, 0.3f);
    return texture.sample(uv, long_axis, short_axis, taps).x();
  };
  return at(diagonal ? 3.5f : 4.0f) - at(diagonal ? 11.5f : 12.0f);
}

TEST(Texture, StaysSharpAcrossALongFootprintWithEnoughProbes) {
  EXPECT_GT(contrast_of_stripes(false, 12), 0.95);
  EXPECT_LT(contrast_of_stripes(false, 1), 0.6);
  EXPECT_GT(contrast_of_stripes(true, 16), 0.9);
  EXPECT_LT(contrast_of_stripes(true, 1), 0.6);
}

TEST(Texture, AveragesAlongTheLongFootprint) {
  // Stripes perpendicular to the footprint's long axis, which spans two whole periods.
  const Texture texture(grey_picture(128, [](int row, int) { return row / 4 % 2 == 0 ? 255 : 0; }));
  for (float row = 0.0f; row < 8.0f; row += 0.7f) {
    const float seen = texture.sample({0.5f, row / 128.0f}, {1.0f / 128.0f, 0.0f}, {0.0f, 16.0f / 128.0f}, 16).x();
    EXPECT_NEAR(seen, 0.5, 0.04);
  }
}

cv::Mat leafy_picture() {
  cv::Mat4b picture(128, 128, cv::Vec4b(255, 0, 255, 0));  // holes of a colour that must never be visible
  Random random(5, "leaves");
  for (int leaf = 0; leaf < 220; ++leaf) {
    const cv::Rect box(random.below(124), random.below(124), 5, 3);
    picture(box) = cv::Vec4b(0, 128, 0, 255);
  }
  return picture;
}

TEST(Texture, KeepsTheShareOfHolesInItsDistance) {
  const Texture texture(leafy_picture());
  const auto covered = [&](float footprint) {
    int hits = 0;
    for (int row = 0; row < 128; ++row) {
      for (int column = 0; column < 128; ++column) {
        const Uv uv((static_cast<float>(column) + 0.5f) / 128.0f, (static_cast<float>(row) + 0.5f) / 128.0f);
        hits += texture.sample(uv, {footprint / 128.0f, 0.0f}, {0.0f, footprint / 128.0f}, 1).w() >= 0.5f ? 1 : 0;
      }
    }
    return hits / (128.0 * 128.0);
  };
  const double near = covered(1.0f);
  EXPECT_GT(near, 0.1);
  EXPECT_LT(near, 0.3);
  EXPECT_NEAR(covered(2.0f), near, 0.04);
  EXPECT_NEAR(covered(4.0f), near, 0.05);
  EXPECT_NEAR(covered(8.0f), near, 0.08);
}

TEST(Texture, DoesNotLetTheHolesColourBleedIntoTheLeaves) {
  const Texture texture(leafy_picture());
  const Eigen::Vector4f seen = texture.sample({0.4f, 0.6f}, {8.0f / 128.0f, 0.0f}, {0.0f, 8.0f / 128.0f}, 1);
  EXPECT_LT(seen.x(), 0.02);
  EXPECT_NEAR(seen.y(), kLinearOf128, 0.02);
  EXPECT_NEAR(texture.mean().y(), kLinearOf128, 0.01);
}

TEST(Texture, TellsAlphaOfItsFinestLevel) {
  cv::Mat4b picture(4, 4, cv::Vec4b(9, 9, 9, 0));
  picture(2, 1) = cv::Vec4b(9, 9, 9, 255);
  const Texture texture(picture);
  EXPECT_NEAR(texture.alpha({1.5f / 4.0f, 2.5f / 4.0f}), 1.0, 1e-5);
  EXPECT_NEAR(texture.alpha({1.5f / 4.0f - 7.0f, 3.0f / 4.0f + 2.0f}), 0.5, 1e-3);
  EXPECT_NEAR(texture.alpha({3.5f / 4.0f, 0.5f / 4.0f}), 0.0, 1e-5);
}

TEST(Texture, HoldsEachLevelOfThePyramidAfterTheFinerOne) {
  const Texture texture(cv::Mat(4, 8, CV_8UC4, cv::Scalar(255, 255, 255, 255)));
  EXPECT_EQ(texture.texels().size(), 4U * (8 * 4 + 4 * 2 + 2 * 1 + 1));
}

TEST(Texture, SurvivesAFootprintThatIsNotANumber) {
  const Texture texture(cv::Mat(8, 8, CV_8UC4, cv::Scalar(128, 128, 128, 255)));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float huge = std::numeric_limits<float>::max();
  texture.sample({0.1f, 0.2f}, {nan, nan}, {nan, nan}, 4);
  EXPECT_NEAR(texture.sample({0.1f, 0.2f}, {huge, 0.0f}, {0.0f, huge}, 4).w(), 1.0, 1e-3);
}

TEST(Texture, RefusesASizeThatIsNoPowerOfTwo) {
  EXPECT_THROW(Texture(cv::Mat(12, 16, CV_8UC4, cv::Scalar())), std::invalid_argument);
  EXPECT_THROW(Texture(cv::Mat(16, 16, CV_8UC3, cv::Scalar())), std::invalid_argument);
  EXPECT_THROW(Texture{cv::Mat()}, std::invalid_argument);
}

}  // namespace
}  // namespace panvo::simulated_world
