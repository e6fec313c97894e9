// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "../shapes.hpp"
#include "facade.hpp"

namespace panvo::simulated_world {
namespace {

template <typename T, std::size_t N>
T drawn_from(Random& random, const std::array<T, N>& choices) {
  return choices[static_cast<std::size_t>(random.below(static_cast<int>(N)))];
}

/// A tint close to white, randomly warmer or cooler.
Tint weathered(Random& random, double low, double high) {
  const float brightness = between(random, low, high);
  return tint_of(brightness, brightness * between(random, 0.92, 1.0), brightness * between(random, 0.84, 1.0));
}

Tint paint(Random& random) {
  switch (random.below(7)) {
    case 0:
      return tint_of(0.24f, 0.34f, 0.22f);
    case 1:
      return tint_of(0.38f, 0.2f, 0.14f);
    case 2:
      return tint_of(0.2f, 0.27f, 0.38f);
    case 3:
      return tint_of(0.45f, 0.34f, 0.22f);
    case 4:
      return tint_of(0.5f, 0.13f, 0.1f);
    case 5:
      return tint_of(0.25f, 0.25f, 0.27f);
    default:
      return tint_of(0.8f, 0.78f, 0.72f);
  }
}

void draw_windows(FacadeStyle& style, Random& random) {
  style.window = drawn_from(random, std::array{WindowKind::kCasement, WindowKind::kCross, WindowKind::kCross,
                                               WindowKind::kSash, WindowKind::kLattice, WindowKind::kPlain});
  const float proportion = between(random, 1.15, 1.9);  // height to width
  style.window_width = between(random, 0.95, 1.4);
  style.sill_height = between(random, 0.75, 1.0);
  style.window_height = std::min(style.window_width * proportion, style.floor_height - style.sill_height - 0.5f);
  style.bay = style.window_width * between(random, 1.75, 2.8);
  style.recess = between(random, 0.12, 0.25);
  style.head = drawn_from(random, std::array{HeadKind::kFlat, HeadKind::kFlat, HeadKind::kFlat, HeadKind::kSegment});
  style.ground_head = random.chance(0.25) ? HeadKind::kArch : style.head;
  const float white = between(random, 0.7, 0.95);
  style.frame_tint = random.chance(0.7) ? tint_of(white, white, white * 0.97f) : paint(random);
}

void draw_house(FacadeStyle& style, const BuildingMaterials& materials, Random& random) {
  style.floors = 1 + random.below(3);
  style.ground_floor_height = between(random, 2.8, 3.2);
  style.floor_height = between(random, 2.6, 2.9);
  draw_windows(style, random);
  style.roof = random.chance(0.7) ? RoofKind::kGable : RoofKind::kHip;
  style.roof_slope = between(random, 0.6, 1.1);
  style.dormers = random.chance(0.45);
  style.shutters = random.chance(0.45);
  style.lintels = random.chance(0.3);
  style.eaves = between(random, 0.35, 0.7);
  style.cornice = 0.0f;
  style.balconies = random.chance(0.25);
  style.ivy = random.chance(0.25);
  style.blank_bays = 0.2f;
  style.two_tone = random.chance(0.2);
  if (style.two_tone) style.ground_wall = materials.stone_rubble;
}

void draw_town(FacadeStyle& style, const BuildingMaterials& materials, Random& random) {
  style.floors = 2 + random.below(4);
  style.ground_floor_height = between(random, 3.4, 4.2);
  style.floor_height = between(random, 2.9, 3.5);
  draw_windows(style, random);
  style.roof = drawn_from(random, std::array{RoofKind::kGable, RoofKind::kHip, RoofKind::kHip, RoofKind::kFlat});
  style.roof_slope = between(random, 0.5, 0.9);
  style.dormers = random.chance(0.5);
  style.ledges = random.chance(0.75);
  style.cornice = between(random, 0.18, 0.45);
  style.dentils = random.chance(0.35);
  style.surrounds = random.chance(0.55);
  style.lintels = !style.surrounds && random.chance(0.6);
  style.keystones = style.surrounds && random.chance(0.5);
  style.pediments = style.surrounds && random.chance(0.4);
  style.quoins = random.chance(0.35);
  style.balconies = random.chance(0.4);
  style.shopfronts = random.chance(0.35);
  style.ivy = random.chance(0.15);
  style.two_tone = random.chance(0.45);
  if (style.two_tone) style.ground_wall = materials.stone_blocks;
}

void draw_institute(FacadeStyle& style, const BuildingMaterials& materials, Random& random) {
  style.floors = 2 + random.below(4);
  style.ground_floor_height = between(random, 3.6, 4.2);
  style.floor_height = between(random, 3.3, 3.7);
  style.bay = between(random, 2.6, 4.2);
  style.window = random.chance(0.6) ? WindowKind::kBand : WindowKind::kCasement;
  const bool is_band = style.window == WindowKind::kBand;
  style.window_width = style.bay - (is_band ? between(random, 0.25, 0.5) : between(random, 0.9, 1.4));
  style.window_height = between(random, 1.5, 2.0);
  style.sill_height = between(random, 0.85, 1.0);
  style.recess = between(random, 0.14, 0.25);
  style.roof = RoofKind::kFlat;
  style.chimneys = false;
  style.ledges = random.chance(0.5);
  style.pilasters = random.chance(0.45);
  style.cornice = between(random, 0.08, 0.2);
  style.gutters = false;
  style.blank_bays = 0.3f;
  const float dark = between(random, 0.25, 0.9);
  style.frame_tint = tint_of(dark, dark, dark);
  style.wall = random.chance(0.6) ? materials.concrete_panels : style.wall;
  style.two_tone = random.chance(0.3);
  if (style.two_tone) style.ground_wall = random.chance(0.5) ? materials.brick_red : materials.stone_blocks;
}

void draw_hall(FacadeStyle& style, const BuildingMaterials& materials, Random& random) {
  style.floors = 1;
  style.ground_floor_height = between(random, 6.0, 8.5);
  style.bay = between(random, 4.5, 6.0);
  style.window = WindowKind::kBand;
  style.window_width = style.bay - between(random, 0.6, 1.6);
  style.window_height = between(random, 1.2, 1.8);
  style.sill_height = style.ground_floor_height - style.window_height - between(random, 0.8, 1.4);
  style.recess = 0.12f;
  style.roof = random.chance(0.5) ? RoofKind::kGable : RoofKind::kFlat;
  style.roof_slope = 0.25f;
  style.chimneys = false;
  style.sills = false;
  style.pilasters = random.chance(0.6);
  style.cornice = 0.1f;
  style.wall = random.chance(0.6) ? materials.metal_sheet : materials.brick_red;
  style.roof_cover = materials.metal_sheet;
  style.base_height = between(random, 0.6, 1.2);
  style.frame_tint = grey(0.5f);
}

}  // namespace

BuildingMaterials::BuildingMaterials(const Palette& palette) {
  for (const auto& [number, name] : {std::pair{&glass, "glass"},
                                     {&window_frame, "window_frame"},
                                     {&door_wood, "door_wood"},
                                     {&shutter, "shutter"},
                                     {&ledge, "ledge"},
                                     {&roof_tiles, "roof_tiles"},
                                     {&roof_slate, "roof_slate"},
                                     {&roof_gravel, "roof_gravel"},
                                     {&gutter, "gutter"},
                                     {&curtain_light, "curtain_light"},
                                     {&curtain_dark, "curtain_dark"},
                                     {&concrete, "concrete"},
                                     {&slabs, "slabs"},
                                     {&metal_painted, "metal_painted"},
                                     {&metal_post, "metal_post"},
                                     {&metal_sheet, "metal_sheet"},
                                     {&concrete_panels, "concrete_panels"},
                                     {&lamp_head, "lamp_head"},
                                     {&sign_white, "sign_white"},
                                     {&sign_blue, "sign_blue"},
                                     {&poster, "poster"},
                                     {&leaves, "leaves_broad"},
                                     {&wood_planks, "wood_planks"},
                                     {&stone_blocks, "stone_blocks"},
                                     {&stone_rubble, "stone_rubble"},
                                     {&plaster_white, "plaster_white"},
                                     {&brick_red, "brick_red"},
                                     {&wood_fence, "wood_fence"}}) {
    *number = palette.find(name);
  }
  leaves_period_m = palette.materials()[leaves].period_m;
}

FacadeStyle draw_style(BuildingUse use, const Palette& palette, const BuildingMaterials& materials, Random random) {
  FacadeStyle style;
  style.use = use;
  constexpr std::array kWalls{"brick_red",     "brick_yellow", "brick_dark",    "plaster_white",
                              "plaster_ochre", "plaster_grey", "plaster_pink",  "plaster_white",
                              "stone_blocks",  "stone_rubble", "plaster_ochre", "wood_planks"};
  const int town_walls = static_cast<int>(kWalls.size()) - (use == BuildingUse::kHouse ? 0 : 1);
  style.wall = palette.find(kWalls[static_cast<std::size_t>(random.below(town_walls))]);
  style.wall_tint = weathered(random, 0.8, 1.0);
  style.trim_tint = weathered(random, 0.75, 1.0);
  style.shutter_tint = paint(random);
  style.door_tint = random.chance(0.5) ? paint(random) : weathered(random, 0.6, 1.0);
  style.roof_tint = weathered(random, 0.7, 1.0);
  style.trim = materials.ledge;
  style.base = drawn_from(
      random, std::array{materials.concrete, materials.stone_blocks, materials.ledge, materials.stone_rubble});
  style.base_height = between(random, 0.3, 0.75);
  style.roof_cover = random.chance(0.65) ? materials.roof_tiles : materials.roof_slate;
  style.grime = between(random, 0.12, 0.38);
  switch (use) {
    case BuildingUse::kHouse:
      draw_house(style, materials, random);
      break;
    case BuildingUse::kTown:
      draw_town(style, materials, random);
      break;
    case BuildingUse::kInstitute:
      draw_institute(style, materials, random);
      break;
    case BuildingUse::kHall:
      draw_hall(style, materials, random);
      break;
  }
  if (style.roof == RoofKind::kFlat) style.roof_cover = materials.roof_gravel;
  if (!style.two_tone) style.ground_wall = style.wall;
  return style;
}

float wall_height(const FacadeStyle& style) {
  return style.ground_floor_height + static_cast<float>(style.floors - 1) * style.floor_height +
         (style.roof == RoofKind::kFlat ? 0.6f : 0.2f);
}

}  // namespace panvo::simulated_world
