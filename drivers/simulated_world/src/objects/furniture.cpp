// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "furniture_planner.hpp"
#include "mover_models.hpp"

namespace panvo::simulated_world {
namespace {

constexpr float kLampHeight_m = 6.5f, kLanternHeight_m = 3.6f;

/// The lights of the lamp posts that were set up; outside their housings, so that these cast no shadow.
void light_lamps(const FurnitureModels& models, Scene& scene) {
  for (const auto& placement : scene.standing) {
    const auto add = [&](const Eigen::Vector3f& in_model, float intensity, bool hangs) {
      scene.lamps.push_back({placement.world_from_model * in_model, intensity, hangs});
    };
    if (placement.model == models.lamp) add({0.0f, -1.85f, kLampHeight_m + 0.3f}, 2.4f, true);
    if (placement.model == models.lantern) add({0.0f, 0.0f, kLanternHeight_m + 0.2f}, 0.7f, false);
  }
}

}  // namespace

FurnitureModels build_furniture_models(const Palette& palette, std::uint64_t seed, Scene& scene) {
  const PlantMaterials plants(palette);
  const FurnitureMaterials things(palette);
  const MoverMaterials movers(palette);
  const Random random(seed, "furniture models");
  std::uint64_t part = 0;
  const auto add = [&](Mesh mesh) {
    scene.models.push_back(std::move(mesh));
    return static_cast<std::uint32_t>(scene.models.size() - 1);
  };
  const auto tree = [&](TreeKind kind) { return add(build_tree(kind, plants, random.part(++part))); };
  FurnitureModels models;
  models.street_trees = {tree(TreeKind::kBroad), tree(TreeKind::kBroad), tree(TreeKind::kBirch),
                         tree(TreeKind::kPoplar), tree(TreeKind::kYoung)};
  models.conifers = {tree(TreeKind::kSpruce), tree(TreeKind::kSpruce), tree(TreeKind::kPine)};
  models.lawn_trees = models.street_trees;
  models.lawn_trees.insert(models.lawn_trees.end(), models.conifers.begin(), models.conifers.end());
  models.lawn_trees.push_back(tree(TreeKind::kSpreading));
  models.lawn_trees.push_back(tree(TreeKind::kSpreading));
  for (const float height : {0.8f, 1.1f, 1.5f, 1.9f})
    models.shrubs.push_back(add(build_shrub(plants, height, height < 1.2f, random.part(++part))));
  for (int i = 0; i < 2; ++i) models.flower_beds.push_back(add(build_flower_bed(plants, random.part(++part))));
  for (int i = 0; i < 3; ++i) models.hedges.push_back(add(build_hedge(plants, 1.35f, 0.8f, random.part(++part))));
  for (int i = 0; i < 3; ++i) models.low_hedges.push_back(add(build_hedge(plants, 0.75f, 0.6f, random.part(++part))));
  for (const auto kind : {FenceKind::kSlats, FenceKind::kBars, FenceKind::kWall, FenceKind::kBrickWall}) {
    models.fences.push_back(add(build_fence(things, kind, random.part(++part))));
  }
  for (const auto& shape : car_shapes()) models.cars.push_back(add(build_car(shape, movers)));
  models.vans.push_back(add(build_car(van_shapes().front(), movers)));
  models.stop_signs = {add(build_sign(things, SignKind::kStop))};
  for (const auto kind : {SignKind::kSquare, SignKind::kPlace, SignKind::kArrow})
    models.signs.push_back(add(build_sign(things, kind)));
  models.lamp = add(build_lamp_post(things, kLampHeight_m, false));
  models.lantern = add(build_lamp_post(things, kLanternHeight_m, true));
  models.litter_bin = add(build_litter_bin(things));
  models.wheelie_bin = add(build_wheelie_bin(things));
  models.bench = add(build_bench(things));
  models.bollard = add(build_bollard(things));
  models.hydrant = add(build_hydrant(things));
  models.cabinet = add(build_cabinet(things));
  models.bicycles = add(build_bicycle_stand(things, random.part(++part)));
  models.notice_board = add(build_notice_board(things));
  return models;
}

void build_furniture(const Site& site, const std::vector<Plot>& plots, Scene& scene) {
  const FurnitureModels models = build_furniture_models(*site.palette, site.parameters.seed, scene);
  FurniturePlanner planner(site, plots, models, scene);
  if (site.parameters.layout == Layout::kFields) return planner.plant_horizon();
  // objects with the fewest possible positions come first
  planner.furnish_open_plots();
  planner.furnish_kerbs();
  if (site.parameters.layout != Layout::kCarParks) {
    planner.fill_drives();
    planner.edge_gardens();
    planner.plant_rows();
    planner.plant_at_walls();
  }
  planner.scatter_trees();
  light_lamps(models, scene);
}

}  // namespace panvo::simulated_world
