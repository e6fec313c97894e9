// SPDX-License-Identifier: Apache-2.0
#include "mover_models.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "../shapes.hpp"
#include "panvo/simulated_world/site.hpp"

namespace panvo::simulated_world {
namespace {

constexpr int kPeople = 8;

/// The rack that carries the rig, with the panoramic camera's mast in the middle.
void add_rig_rack(Mesh& mesh, const CarShape& shape, const MoverMaterials& materials) {
  const float roof = shape.roof;
  for (const float x : {-1.05f, 0.1f}) {
    add_tube(mesh, {x, -0.6f, roof + 0.06f}, {x, 0.6f, roof + 0.06f}, 0.02f, 0.02f, 6, materials.car_trim, grey(0.7f));
    for (const float y : {-0.55f, 0.55f})
      add_tube(mesh, {x, y, roof - 0.08f}, {x, y, roof + 0.06f}, 0.03f, 0.025f, 6, materials.car_trim, grey(0.6f));
  }
  mesh.add_column({-0.25f, 0.0f, roof - 0.05f}, 0.09f, 0.06f, 0.2f, 12, materials.car_trim, grey(0.5f));
}

}  // namespace

MoverMaterials::MoverMaterials(const Palette& palette) {
  for (const auto& [number, name] : {std::pair{&car_paint, "car_paint"},
                                     {&car_glass, "car_glass"},
                                     {&car_trim, "car_trim"},
                                     {&tyre, "tyre"},
                                     {&rim, "rim"},
                                     {&lamp_head, "lamp_head"},
                                     {&lamp_rear, "lamp_rear"},
                                     {&plate, "plate"},
                                     {&skin, "skin"},
                                     {&hair, "hair"},
                                     {&cloth_a, "cloth_a"},
                                     {&cloth_b, "cloth_b"},
                                     {&cloth_c, "cloth_c"},
                                     {&shoes, "shoes"}}) {
    *number = palette.find(name);
  }
}

std::vector<CarShape> car_shapes() {
  CarShape hatchback;
  hatchback.length = 3.9f;
  hatchback.width = 1.7f;
  hatchback.screen_foot = 0.85f;
  hatchback.screen_top = 0.2f;
  hatchback.rear_foot = -1.82f;
  hatchback.rear_top = -1.42f;
  hatchback.front_wheel = 1.22f;
  hatchback.rear_wheel = -1.22f;
  hatchback.panes = {{0.12f, 0.24f}, {0.28f, 0.54f}, {0.58f, 0.9f}};
  CarShape saloon;
  saloon.length = 4.55f;
  saloon.roof = 1.43f;
  saloon.rear_foot = -1.55f;
  saloon.rear_top = -0.85f;
  saloon.boot = 0.99f;
  saloon.tail = 0.93f;
  saloon.front_wheel = 1.38f;
  saloon.rear_wheel = -1.3f;
  saloon.panes = {{0.2f, 0.5f}, {0.54f, 0.88f}};
  CarShape estate = saloon;
  estate.length = 4.65f;
  estate.rear_foot = -2.12f;
  estate.rear_top = -1.85f;
  estate.roof = 1.46f;
  estate.panes = {{0.06f, 0.28f}, {0.33f, 0.57f}, {0.6f, 0.88f}};
  CarShape small = hatchback;
  small.length = 3.55f;
  small.width = 1.62f;
  small.roof = 1.5f;
  small.nose = 0.76f;
  small.screen_foot = 0.9f;
  small.screen_top = 0.3f;
  small.rear_foot = -1.68f;
  small.rear_top = -1.45f;
  small.front_wheel = 1.15f;
  small.rear_wheel = -1.15f;
  small.wheel_radius = 0.28f;
  small.panes = {{0.08f, 0.4f}, {0.45f, 0.9f}};
  CarShape tall = estate;  // an off-road vehicle
  tall.length = 4.4f;
  tall.width = 1.84f;
  tall.roof = 1.72f;
  tall.sill = 0.34f;
  tall.nose = 0.86f;
  tall.bonnet = 1.06f;
  tall.boot = 1.1f;
  tall.tail = 1.06f;
  tall.wheel_radius = 0.36f;
  tall.rear_foot = -2.02f;
  tall.rear_top = -1.78f;
  tall.lean = 0.86f;
  return {hatchback, saloon, estate, small, tall};
}

std::vector<CarShape> van_shapes() {
  CarShape van;
  van.length = 4.9f;
  van.width = 1.9f;
  van.roof = 1.95f;
  van.sill = 0.28f;
  van.nose = 0.85f;
  van.bonnet = 1.15f;
  van.boot = van.tail = 1.12f;
  van.screen_foot = 1.65f;
  van.screen_top = 0.95f;
  van.rear_foot = -2.4f;
  van.rear_top = -2.33f;
  van.front_wheel = 1.55f;
  van.rear_wheel = -1.5f;
  van.wheel_radius = 0.34f;
  van.lean = 0.93f;
  van.panes = {{0.66f, 0.9f}};
  CarShape bus = van;
  bus.length = 6.6f;
  bus.width = 2.1f;
  bus.roof = 2.6f;
  bus.screen_foot = 2.75f;
  bus.screen_top = 2.35f;
  bus.rear_foot = -3.25f;
  bus.rear_top = -3.15f;
  bus.front_wheel = 2.2f;
  bus.rear_wheel = -1.9f;
  bus.wheel_radius = 0.4f;
  bus.bonnet = 1.25f;
  bus.panes = {{0.05f, 0.22f}, {0.24f, 0.4f}, {0.42f, 0.58f}, {0.6f, 0.76f}, {0.79f, 0.94f}};
  return {van, bus};
}

CarShape own_vehicle_shape() {
  CarShape shape;
  shape.length = 4.2f;
  shape.width = 1.78f;
  shape.roof = 1.55f;
  shape.nose = 0.74f;
  shape.bonnet = 0.94f;
  shape.screen_foot = 1.0f;
  shape.screen_top = 0.35f;
  shape.rear_foot = -2.0f;
  shape.rear_top = -1.85f;
  shape.lean = 0.88f;
  shape.panes = {{0.06f, 0.28f}, {0.32f, 0.57f}, {0.61f, 0.9f}};
  shape.body = tint_of(0.1f, 0.19f, 0.33f);
  return shape;
}

double own_vehicle_height_m(double x_m, double y_m) {
  const CarShape shape = own_vehicle_shape();
  const std::array<std::pair<double, double>, 6> outline{{{-0.5 * shape.length, shape.tail},
                                                          {shape.rear_foot, shape.boot},
                                                          {shape.rear_top, shape.roof},
                                                          {shape.screen_top, shape.roof},
                                                          {shape.screen_foot, shape.bonnet},
                                                          {0.5 * shape.length, shape.nose}}};
  if (std::abs(y_m) > 0.5 * shape.width || x_m < outline.front().first || x_m > outline.back().first) return 0.0;
  const auto ahead =
      std::find_if(outline.begin() + 1, outline.end() - 1, [&](const auto& corner) { return x_m <= corner.first; });
  const auto [x0, z0] = *(ahead - 1);
  return std::lerp(z0, ahead->second, (x_m - x0) / (ahead->first - x0));
}

Mesh build_lorry(const MoverMaterials& materials) {
  CarShape cab = van_shapes().front();
  cab.length = 6.4f;
  cab.width = 2.05f;
  cab.roof = 2.2f;
  cab.front_wheel = 2.35f;
  cab.rear_wheel = -1.75f;
  cab.wheel_radius = 0.4f;
  cab.sill = 0.38f;
  cab.nose = 1.0f;
  cab.bonnet = 1.3f;
  cab.boot = cab.tail = 1.0f;
  cab.screen_foot = 2.7f;
  cab.screen_top = 2.1f;
  cab.rear_foot = 0.9f;
  cab.rear_top = 1.0f;
  cab.panes = {{0.3f, 0.92f}};
  cab.has_rear_window = false;
  Mesh mesh = build_car(cab, materials);
  add_block(mesh, {-3.22f, -1.08f, 0.92f}, {0.8f, 1.08f, 2.9f}, materials.car_paint, grey(1.0f));
  for (const float y : {-1.085f, 1.085f}) {
    for (const float z : {0.95f, 2.87f})
      add_tube(mesh, {-3.22f, y, z}, {0.8f, y, z}, 0.03f, 0.03f, 6, materials.car_trim, grey(0.8f));
    for (const float x : {-3.2f, 0.78f})
      add_tube(mesh, {x, y, 0.92f}, {x, y, 2.9f}, 0.03f, 0.03f, 6, materials.car_trim, grey(0.8f));
    add_tube(mesh, {-3.235f, 0.06f * y, 1.0f}, {-3.235f, 0.06f * y, 2.8f}, 0.015f, 0.015f, 5, materials.rim,
             grey(0.8f));
  }
  return mesh;
}

MoverModels build_mover_models(const Palette& palette, std::uint64_t seed, Scene& scene) {
  const MoverMaterials materials(palette);
  const Random random(seed, "mover models");
  MoverModels models;
  const auto add = [&](Mesh mesh) {
    scene.models.push_back(std::move(mesh));
    return static_cast<std::uint32_t>(scene.models.size() - 1);
  };
  for (const auto& shape : car_shapes()) models.cars.push_back(add(build_car(shape, materials)));
  for (const auto& shape : van_shapes()) models.vans.push_back(add(build_car(shape, materials)));
  models.vans.push_back(add(build_lorry(materials)));
  for (int i = 0; i < kPeople; ++i)
    models.people.push_back(add(build_person(materials, random.part(static_cast<std::uint64_t>(i)))));
  const CarShape own = own_vehicle_shape();
  Mesh mesh = build_car(own, materials);
  add_rig_rack(mesh, own, materials);
  models.own_vehicle = add(std::move(mesh));
  return models;
}

}  // namespace panvo::simulated_world
