// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/palette.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::simulated_world {
namespace {

using panvo::test::TemporaryFolder;

constexpr std::uint64_t kSeed = 11;

const Palette& palette() {
  static const Palette made(kSeed, {});
  return made;
}

const Material& material(std::string_view name) { return palette().materials()[palette().find(name)]; }

/// With these materials painted only, which takes less time.
Palette palette_of(const std::vector<std::string>& only, Season season = Season::kSummer, bool wet = false) {
  return Palette(kSeed, {}, season, wet, only);
}

TEST(Palette, HasEveryMaterialOfTheCampus) {
  for (const char* name : {"asphalt",      "asphalt_patch", "asphalt_smooth",  "concrete",     "kerb",
                           "slabs",        "cobbles",       "gravel",          "grass",        "soil",
                           "marking",      "manhole",       "far_land",        "brick_red",    "brick_yellow",
                           "brick_dark",   "plaster_white", "plaster_ochre",   "plaster_grey", "plaster_pink",
                           "stone_blocks", "stone_rubble",  "concrete_panels", "wood_planks",  "metal_sheet",
                           "glass",        "window_frame",  "door_wood",       "shutter",      "ledge",
                           "roof_tiles",   "roof_slate",    "roof_gravel",     "gutter",       "curtain_light",
                           "curtain_dark", "bark",          "leaves_broad",    "leaves_small", "leaves_needle",
                           "hedge",        "flowers",       "car_paint",       "car_glass",    "car_trim",
                           "tyre",         "rim",           "lamp_head",       "lamp_rear",    "plate",
                           "metal_post",   "metal_painted", "wood_fence",      "bin_plastic",  "sign_red",
                           "sign_blue",    "sign_white",    "poster",          "skin",         "hair",
                           "cloth_a",      "cloth_b",       "cloth_c",         "shoes"}) {
    EXPECT_EQ(material(name).name, name);
    EXPECT_NE(material(name).albedo, nullptr);
    EXPECT_GT(material(name).period_m, 0.0f);
  }
}

TEST(Palette, HasTwigsInPlaceOfLeavesInWinter) {
  const std::vector<std::string> leaves{"leaves_broad", "leaves_small", "leaves_needle"};
  const Palette summer = palette_of(leaves), bare = palette_of(leaves, Season::kBare);
  const auto covered = [](const Palette& from, std::string_view name) {
    return from.materials()[from.find(name)].albedo->mean().w();
  };
  for (const char* name : {"leaves_broad", "leaves_small"}) {
    EXPECT_LT(covered(bare, name), 0.5f * covered(summer, name)) << name;
    EXPECT_GT(covered(bare, name), 0.01f) << name;
  }
  EXPECT_EQ(covered(bare, "leaves_needle"), covered(summer, "leaves_needle"));
}

TEST(Palette, HasSnowInWinterOnly) {
  const Palette summer = palette_of({"grass"}), winter = palette_of({"grass"}, Season::kSnow);
  for (const auto& material : summer.materials()) EXPECT_EQ(material.snow, 0.0f) << material.name;
  EXPECT_EQ(winter.materials()[winter.find("grass")].snow, 1.0f);
  EXPECT_LT(winter.materials()[winter.find("asphalt")].snow, 0.5f);
  EXPECT_EQ(winter.materials()[winter.find("glass")].snow, 0.0f);
}

TEST(Palette, HasWaterOnRoadsAndPavementsAfterRainOnly) {
  const Palette dry = palette_of({"grass"}), wet = palette_of({"grass"}, Season::kSummer, true);
  for (const auto& material : dry.materials()) EXPECT_EQ(material.wet, 0.0f) << material.name;
  for (const char* name : {"asphalt", "asphalt_patch", "slabs", "kerb", "marking"}) {
    EXPECT_EQ(wet.materials()[wet.find(name)].wet, 1.0f) << name;
  }
  for (const char* name : {"grass", "gravel", "brick_red", "concrete_panels", "roof_tiles", "car_paint"}) {
    EXPECT_EQ(wet.materials()[wet.find(name)].wet, 0.0f) << name;
  }
}

TEST(Palette, PaintsOnlyWhatIsAskedForAndThatAsAlways) {
  const Palette few = palette_of({"grass", "marking"});
  for (const Material& one : few.materials()) {
    const bool is_asked_for = one.name == "grass" || one.name == "marking";
    EXPECT_EQ(one.albedo->texels() == material(one.name).albedo->texels(), is_asked_for) << one.name;
    EXPECT_EQ(one.overlay != nullptr, one.name == "grass") << one.name;
  }
  EXPECT_TRUE(few.materials()[few.find("grass")].overlay->texels() == material("grass").overlay->texels());
}

TEST(Palette, NamesTheMaterialItDoesNotHave) {
  try {
    Palette::unpainted().find("marble");
    FAIL();
  } catch (const std::out_of_range& error) {
    EXPECT_NE(std::string(error.what()).find("marble"), std::string::npos);
  }
}

TEST(Palette, KnowsFamiliesByTheBeginningOfTheirNames) {
  const Palette palette = Palette::unpainted();
  const auto bricks = palette.family("brick");
  ASSERT_EQ(bricks.size(), 3U);
  for (const std::uint16_t number : bricks) EXPECT_TRUE(palette.materials()[number].name.starts_with("brick"));
  EXPECT_EQ(palette.family("leaves").size(), 3U);
  EXPECT_TRUE(palette.family("marble").empty());
}

TEST(Palette, ReflectsAsMuchLightAsRealSurfacesDo) {
  const auto expect_albedo = [](const char* name, double low, double high) {
    const double albedo = material(name).albedo->mean().head<3>().mean();
    EXPECT_GT(albedo, low) << name;
    EXPECT_LT(albedo, high) << name;
  };
  expect_albedo("asphalt", 0.07, 0.16);
  expect_albedo("asphalt_patch", 0.03, 0.10);
  expect_albedo("concrete", 0.2, 0.4);
  expect_albedo("slabs", 0.15, 0.35);
  expect_albedo("grass", 0.04, 0.2);
  expect_albedo("marking", 0.4, 0.7);
  expect_albedo("plaster_white", 0.5, 0.75);
  expect_albedo("brick_red", 0.1, 0.3);
  expect_albedo("leaves_broad", 0.04, 0.2);
  expect_albedo("glass", 0.0, 0.05);
  expect_albedo("tyre", 0.0, 0.05);
  for (const Material& one : palette().materials()) EXPECT_LT(one.albedo->mean().maxCoeff(), 1.001f) << one.name;
}

/// Mean difference between the texels of adjacent columns, in level 0.
double step_between(const Texture& texture, int column, bool along_rows) {
  const int width = texture.width();
  const auto& texels = texture.texels();
  double sum = 0.0;
  for (int other = 0; other < width; ++other) {
    const int next = (column + 1) % width;
    const int here = along_rows ? other * width + column : column * width + other;
    const int there = along_rows ? other * width + next : next * width + other;
    sum += std::abs(texels[4 * here + 1] - texels[4 * there + 1]);
  }
  return sum / width;
}

TEST(Palette, PaintsPicturesThatRepeatWithoutASeam) {
  for (const char* name : {"asphalt", "concrete", "cobbles", "gravel", "grass", "soil", "marking", "plaster_ochre",
                           "stone_rubble", "hedge", "flowers", "bark", "curtain_light", "metal_post", "far_land"}) {
    const Texture& texture = *material(name).albedo;
    ASSERT_EQ(texture.width(), texture.height());
    for (const bool along_rows : {true, false}) {
      double inside = 0.0;
      for (int line = 0; line < 40; ++line)
        inside += step_between(texture, 7 + line * (texture.width() / 50), along_rows) / 40.0;
      const double seam = step_between(texture, texture.width() - 1, along_rows);
      EXPECT_LT(seam, 1.6 * inside + 0.5) << name;
    }
  }
}

TEST(Palette, HasFineContrastOnRoadsForTheirMotionToBeSeen) {
  // Texels of about 5 mm, the resolution of a camera two to three metres ahead.
  const Texture& texture = *material("asphalt").albedo;
  const float step = 2.0f / static_cast<float>(texture.width());
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kCount = 200;
  for (int row = 0; row < kCount; ++row) {
    for (int column = 0; column < kCount; ++column) {
      const Eigen::Vector2f uv = Eigen::Vector2f(static_cast<float>(column), static_cast<float>(row)) * step;
      const double value = texture.sample(uv, {step, 0.0f}, {0.0f, step}, 1).y();
      sum += value;
      squares += value * value;
    }
  }
  const double mean = sum / (kCount * kCount);
  const double deviation = std::sqrt(squares / (kCount * kCount) - mean * mean);
  EXPECT_GT(deviation / mean, 0.15);
  EXPECT_LT(deviation / mean, 0.6);
}

TEST(Palette, OverlaysChangeNoMaterialsMeanAndScatteredOnesFitHoweverTurned) {
  int scattered = 0;
  for (const Material& one : palette().materials()) {
    if (!one.overlay) continue;
    EXPECT_NEAR(one.overlay->mean().x(), 0.5, 0.03) << one.name;
    if (!one.overlay_is_scattered) continue;
    ++scattered;
    for (float along = 0.0f; along < 1.0f; along += 0.01f) {
      const Eigen::Vector2f none = Eigen::Vector2f::Zero();
      EXPECT_NEAR(one.overlay->sample({along, 0.0f}, none, none, 1).x(), 0.5, 0.05) << one.name;
      EXPECT_NEAR(one.overlay->sample({0.0f, along}, none, none, 1).x(), 0.5, 0.05) << one.name;
    }
  }
  EXPECT_GT(scattered, 5);
}

TEST(Palette, CutsHolesBetweenLeavesOnly) {
  for (const Material& one : palette().materials()) {
    EXPECT_EQ(one.has_holes, one.name.starts_with("leaves")) << one.name;
    const float share = one.albedo->mean().w();
    if (one.has_holes) {
      EXPECT_GT(share, 0.2) << one.name;
      EXPECT_LT(share, 0.8) << one.name;
      EXPECT_GT(one.translucency, 0.0) << one.name;
      EXPECT_LT(one.albedo->alpha({0.0f, 0.0f}), 0.5) << one.name;
    } else {
      EXPECT_NEAR(share, 1.0, 1e-4) << one.name;
    }
  }
  for (const char* name : {"glass", "car_paint", "car_glass"}) EXPECT_GT(material(name).gloss, 0.02f) << name;
}

TEST(Palette, DarkensWallsAtTheirFoot) {
  const Texture& wear = *material("plaster_white").overlay;
  const Eigen::Vector2f wide(0.5f, 0.0f);
  const auto brightness = [&](float height_m) {
    float sum = 0.0f;
    for (float along = 0.0f; along < 1.0f; along += 0.01f) {
      const float v = height_m / material("plaster_white").overlay_period_m;
      sum += wear.sample({along, v}, Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero(), 1).x() / 100.0f;
    }
    return sum;
  };
  EXPECT_LT(brightness(0.1f), 0.85f * brightness(3.0f));
}

TEST(Palette, TakesPhotographsInsteadAndLeavesTheRestAsItWas) {
  const TemporaryFolder folder;
  // Bright at the top, dark at the bottom; its size is not a power of two.
  cv::Mat photograph(50, 60, CV_8UC3, cv::Scalar(20, 20, 20));
  photograph.rowRange(0, 25).setTo(cv::Scalar(40, 80, 200));  // blue, green, red
  cv::imwrite((folder / "brick_red.png").string(), photograph);
  folder.write("README.md", "where they are from");
  const Palette with(kSeed, folder.path());
  const Texture& bricks = *with.materials()[with.find("brick_red")].albedo;
  EXPECT_EQ(bricks.width(), 64);
  const Eigen::Vector2f none = Eigen::Vector2f::Zero();
  const Eigen::Vector4f above = bricks.sample({0.5f, 0.75f}, none, none, 1);
  EXPECT_NEAR(above.x(), 0.578, 0.02);
  EXPECT_NEAR(above.z(), 0.021, 0.01);
  EXPECT_LT(bricks.sample({0.5f, 0.25f}, none, none, 1).x(), 0.02);
  for (const Material& one : palette().materials()) {
    if (one.name == "brick_red") continue;
    const Material& other = with.materials()[with.find(one.name)];
    EXPECT_TRUE(one.albedo->texels() == other.albedo->texels()) << one.name;
    EXPECT_EQ(one.overlay == nullptr, other.overlay == nullptr);
    if (one.overlay && other.overlay) {
      EXPECT_TRUE(one.overlay->texels() == other.overlay->texels()) << one.name;
    }
  }
}

TEST(Palette, IsAnotherForAnotherSeed) {
  const Palette other(kSeed + 1, {});
  for (const Material& one : palette().materials()) {
    EXPECT_FALSE(one.albedo->texels() == other.materials()[other.find(one.name)].albedo->texels()) << one.name;
  }
}

TEST(Palette, NamesThePhotographItCannotUse) {
  const auto message_of = [](const std::filesystem::path& folder) -> std::string {
    try {
      const Palette made(kSeed, folder);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  const TemporaryFolder unknown, broken;
  cv::imwrite((unknown / "marble.png").string(), cv::Mat(8, 8, CV_8UC3, cv::Scalar()));
  EXPECT_NE(message_of(unknown.path()).find("marble"), std::string::npos);
  broken.write("grass.jpg", "no picture");
  EXPECT_NE(message_of(broken.path()).find("grass.jpg"), std::string::npos);
  EXPECT_NE(message_of(broken / "nowhere").find("nowhere"), std::string::npos);
}

}  // namespace
}  // namespace panvo::simulated_world
