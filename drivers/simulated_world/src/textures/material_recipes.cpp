// SPDX-License-Identifier: Apache-2.0
#include "material_recipes.hpp"

#include <utility>

#include "painters.hpp"

namespace panvo::simulated_world {
namespace {

// The seed varies the colours before they are passed to the painter.
using Painter = std::function<cv::Mat3f(const Colour&, Random)>;

Painter plain(float blotches, float grain) {
  return [=](const Colour& colour, const Random& random) { return paint_plain(colour, blotches, grain, random); };
}

class Recipes {
 public:
  std::vector<Recipe> take() { return std::move(recipes_); }

  void add_ground() {
    const Colour tar(0.042f, 0.042f, 0.043f);
    add(
        "asphalt", 2.5f, {0.165f, 0.162f, 0.155f},
        [=](const Colour& c, const Random& r) { return paint_asphalt(2.44f, c, tar, 1.0f, r); }, Wear::kRoad);
    add(
        "asphalt_patch", 2.5f, {0.085f, 0.085f, 0.086f},
        [=](const Colour& c, const Random& r) { return paint_asphalt(2.44f, c, tar * 0.6f, 0.9f, r); }, Wear::kNewRoad);
    add(
        "asphalt_smooth", 1.6f, {0.125f, 0.123f, 0.12f},
        [=](const Colour& c, const Random& r) { return paint_asphalt(1.56f, c, tar * 1.6f, 0.45f, r); },
        Wear::kNewRoad);
    add(
        "concrete", 2.0f, {0.31f, 0.30f, 0.275f},
        [](const Colour& c, const Random& r) { return paint_concrete(c, 0.5f, r); }, Wear::kGround);
    add(
        "kerb", 1.0f, {0.33f, 0.325f, 0.31f},
        [](const Colour& c, const Random& r) { return paint_concrete(c, 0.9f, r); }, Wear::kGround);
    add(
        "slabs", 2.4f, {0.27f, 0.26f, 0.235f},
        [](const Colour& c, const Random& r) { return paint_slabs(6, 6, r.part(7).below(2) == 0, c, r); },
        Wear::kGround);
    add(
        "cobbles", 2.0f, {0.19f, 0.183f, 0.172f},
        [](const Colour& c, const Random& r) { return paint_cobbles(18, c, r); }, Wear::kGround);
    add(
        "gravel", 1.6f, {0.25f, 0.235f, 0.205f},
        [](const Colour& c, const Random& r) { return paint_gravel(70, c, r); }, Wear::kGround);
    add(
        "grass", 2.6f, {}, [](const Colour&, const Random& r) { return paint_grass(r); }, Wear::kGround);
    add(
        "soil", 2.0f, {}, [](const Colour&, const Random& r) { return paint_soil(r); }, Wear::kGround);
    add("marking", 2.5f, {}, [](const Colour&, const Random& r) { return paint_marking(r); });
    add("manhole", 0.7f, {}, [](const Colour&, const Random& r) { return paint_manhole(r); });
    add("far_land", 300.0f, {}, [](const Colour&, const Random& r) { return paint_far_land(r); });
  }

  void add_walls() {
    const Colour mortar(0.33f, 0.315f, 0.28f);
    const auto bricks = [=](float variety) {
      return [=](const Colour& c, const Random& r) { return paint_bricks(c, mortar, variety, r); };
    };
    const auto plaster = [](float roughness) {
      return [=](const Colour& c, const Random& r) { return paint_plaster(c, roughness, r); };
    };
    add("brick_red", 1.92f, {0.27f, 0.105f, 0.065f}, bricks(0.6f), Wear::kWall);
    add("brick_yellow", 1.92f, {0.40f, 0.29f, 0.155f}, bricks(0.45f), Wear::kWall);
    add("brick_dark", 1.92f, {0.12f, 0.075f, 0.06f}, bricks(0.8f), Wear::kWall);
    add("plaster_white", 1.5f, {0.62f, 0.61f, 0.575f}, plaster(0.7f), Wear::kPlaster);
    add("plaster_ochre", 1.5f, {0.50f, 0.36f, 0.17f}, plaster(0.8f), Wear::kPlaster);
    add("plaster_grey", 1.5f, {0.34f, 0.34f, 0.33f}, plaster(1.0f), Wear::kPlaster);
    add("plaster_pink", 1.5f, {0.50f, 0.33f, 0.27f}, plaster(0.8f), Wear::kPlaster);
    add(
        "stone_blocks", 3.2f, {0.36f, 0.32f, 0.25f},
        [](const Colour& c, const Random& r) { return paint_stone_blocks(c, r); }, Wear::kWall);
    add(
        "stone_rubble", 3.0f, {0.24f, 0.22f, 0.185f},
        [](const Colour& c, const Random& r) { return paint_rubble(c, r); }, Wear::kWall);
    add(
        "concrete_panels", 4.8f, {0.32f, 0.315f, 0.295f},
        [](const Colour& c, const Random& r) { return paint_concrete_panels(c, r); }, Wear::kWall);
    add(
        "wood_planks", 1.6f, {0.20f, 0.125f, 0.07f},
        [](const Colour& c, const Random& r) { return paint_boards(c, 10, false, r); }, Wear::kWall);
    add(
        "metal_sheet", 2.0f, {0.36f, 0.38f, 0.39f},
        [](const Colour& c, const Random& r) { return paint_sheet(c, 8, r); }, Wear::kWall, 0.03f);
  }

  void add_parts_of_buildings() {
    add(
        "glass", 2.6f, {}, [](const Colour&, const Random& r) { return paint_glass(r); }, Wear::kNone, 0.09f);
    add("window_frame", 1.0f, {0.56f, 0.55f, 0.52f}, plain(0.05f, 0.04f));
    add("door_wood", 1.1f, {0.16f, 0.085f, 0.045f}, [](const Colour& c, const Random& r) { return paint_door(c, r); });
    add("shutter", 1.0f, {0.09f, 0.17f, 0.12f}, [](const Colour& c, const Random& r) { return paint_shutter(c, r); });
    add(
        "ledge", 1.5f, {0.42f, 0.40f, 0.355f},
        [](const Colour& c, const Random& r) { return paint_concrete(c, 0.4f, r); }, Wear::kGround);
    add(
        "roof_tiles", 2.4f, {0.25f, 0.095f, 0.055f},
        [](const Colour& c, const Random& r) { return paint_roof_tiles(c, 8, 10, false, r); }, Wear::kGround);
    add(
        "roof_slate", 2.4f, {0.085f, 0.09f, 0.098f},
        [](const Colour& c, const Random& r) { return paint_roof_tiles(c, 12, 10, true, r); }, Wear::kGround, 0.01f);
    add(
        "roof_gravel", 2.0f, {0.24f, 0.23f, 0.215f},
        [](const Colour& c, const Random& r) { return paint_gravel(60, c, r); }, Wear::kGround);
    add("gutter", 1.0f, {0.30f, 0.31f, 0.32f}, plain(0.12f, 0.05f), Wear::kNone, 0.02f);
    add("curtain_light", 1.2f, {0.52f, 0.49f, 0.43f},
        [](const Colour& c, const Random& r) { return paint_curtain(c, r); });
    add("curtain_dark", 1.2f, {0.10f, 0.07f, 0.06f},
        [](const Colour& c, const Random& r) { return paint_curtain(c, r); });
  }

  void add_plants(Season season) {
    const int broad = season == Season::kSummer ? 190 : 0, small = season == Season::kSummer ? 360 : 0;
    add("bark", 1.2f, {0.115f, 0.085f, 0.06f}, [](const Colour& c, const Random& r) { return paint_bark(c, r); });
    add_leaves("leaves_broad", {0.105f, 0.17f, 0.045f}, {.leaves = broad, .length_m = 0.11f, .width_share = 0.72f});
    add_leaves("leaves_small", {0.125f, 0.185f, 0.055f}, {.leaves = small, .length_m = 0.072f, .width_share = 0.55f});
    add_leaves("leaves_needle", {0.055f, 0.095f, 0.045f}, {.leaves = 0, .length_m = 0.075f, .needles = 70});
    add("hedge", 1.4f, {0.06f, 0.105f, 0.028f}, [](const Colour& c, const Random& r) { return paint_hedge(c, r); });
    add("flowers", 1.4f, {}, [](const Colour&, const Random& r) { return paint_flowers(r); });
  }

  // Paint, cloth and similar materials are pale, so that the models' tints colour them.
  void add_objects() {
    add("car_paint", 2.0f, {0.72f, 0.72f, 0.72f}, plain(0.012f, 0.02f), Wear::kNone, 0.05f);
    add("car_glass", 1.0f, {0.018f, 0.02f, 0.021f}, plain(0.15f, 0.02f), Wear::kNone, 0.08f);
    add("car_trim", 0.5f, {0.03f, 0.03f, 0.032f}, plain(0.08f, 0.1f), Wear::kNone, 0.01f);
    add("tyre", 0.5f, {}, [](const Colour&, const Random& r) { return paint_tyre(r); });
    add("rim", 0.5f, {0.42f, 0.43f, 0.44f}, plain(0.08f, 0.05f), Wear::kNone, 0.05f);
    add("lamp_head", 0.3f, {0.65f, 0.65f, 0.62f}, plain(0.1f, 0.05f), Wear::kNone, 0.06f);
    add("lamp_rear", 0.3f, {0.32f, 0.02f, 0.018f}, plain(0.12f, 0.05f), Wear::kNone, 0.05f);
    add("plate", 0.52f, {}, [](const Colour&, const Random& r) { return paint_plate(r); });
    add("metal_post", 0.6f, {0.30f, 0.31f, 0.315f}, plain(0.10f, 0.08f), Wear::kNone, 0.02f);
    add("metal_painted", 0.8f, {0.52f, 0.52f, 0.51f}, plain(0.06f, 0.05f), Wear::kNone, 0.02f);
    add("wood_fence", 1.2f, {0.22f, 0.155f, 0.10f},
        [](const Colour& c, const Random& r) { return paint_boards(c, 8, true, r); });
    add("bin_plastic", 0.8f, {0.05f, 0.07f, 0.055f}, plain(0.10f, 0.08f), Wear::kNone, 0.01f);
    add("sign_red", 0.6f, {0.42f, 0.022f, 0.02f}, [](const Colour& c, const Random& r) {
      return paint_sign(c, {0.62f, 0.62f, 0.6f}, r);
    });
    add("sign_blue", 0.6f, {0.02f, 0.09f, 0.36f}, [](const Colour& c, const Random& r) {
      return paint_sign(c, {0.62f, 0.62f, 0.6f}, r);
    });
    add("sign_white", 0.6f, {0.63f, 0.63f, 0.61f}, [](const Colour& c, const Random& r) {
      return paint_sign(c, {0.03f, 0.03f, 0.03f}, r);
    });
    add("poster", 1.6f, {}, [](const Colour&, const Random& r) { return paint_poster(r); });
  }

  void add_people() {
    add("skin", 0.5f, {0.42f, 0.27f, 0.19f}, plain(0.05f, 0.05f));
    add("hair", 0.4f, {}, [](const Colour&, const Random& r) { return paint_hair(r); });
    const auto cloth = [](int threads) {
      return [=](const Colour& c, const Random& r) { return paint_cloth(c, threads, r); };
    };
    add("cloth_a", 0.6f, {0.42f, 0.42f, 0.42f}, cloth(64));
    add("cloth_b", 0.6f, {0.09f, 0.11f, 0.17f}, cloth(96));
    add("cloth_c", 0.6f, {0.50f, 0.46f, 0.38f}, cloth(40));
    add("shoes", 0.3f, {0.045f, 0.035f, 0.03f}, plain(0.1f, 0.1f));
  }

 private:
  void add(std::string name, float period_m, const Colour& colour, Painter paint, Wear wear = Wear::kNone,
           float gloss = 0.0f) {
    auto painted = [colour, paint = std::move(paint)](const Random& random) {
      return encoded_picture(paint(varied(colour, 0.12f, 0.04f, random.part(1000)), random));
    };
    recipes_.push_back({std::move(name), period_m, painted, wear, gloss, 0.0f, false});
  }

  void add_leaves(std::string name, const Colour& colour, const LeafShape& shape) {
    auto painted = [colour, shape](const Random& random) {
      const Cutout cutout = paint_leaves(shape, varied(colour, 0.12f, 0.1f, random.part(1000)), random);
      return encoded_picture(cutout.colour, cutout.alpha);
    };
    recipes_.push_back({std::move(name), 1.0f, painted, Wear::kNone, 0.0f, 0.35f, true});
  }

  std::vector<Recipe> recipes_;
};

}  // namespace

std::vector<Recipe> material_recipes(Season season) {
  Recipes recipes;
  recipes.add_ground();
  recipes.add_walls();
  recipes.add_parts_of_buildings();
  recipes.add_plants(season);
  recipes.add_objects();
  recipes.add_people();
  return recipes.take();
}

}  // namespace panvo::simulated_world
