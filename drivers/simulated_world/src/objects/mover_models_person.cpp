// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "../shapes.hpp"
#include "mover_models.hpp"

namespace panvo::simulated_world {
namespace {

using Eigen::Vector3f;

struct Ring {
  Vector3f centre;
  float deep, wide;  ///< half axes along x and y, m
};

/// A body through oval rings, from bottom to top.
void add_rings(Mesh& mesh, const std::vector<Ring>& rings, int sides, std::uint16_t material, Tint tint) {
  std::vector<Vector3f> grid;
  for (const auto& ring : rings) {
    for (int i = 0; i <= sides; ++i) {
      const float angle = 2.0f * kPi * static_cast<float>(i) / static_cast<float>(sides);
      grid.emplace_back(ring.centre + Vector3f(ring.deep * std::cos(angle), ring.wide * std::sin(angle), 0));
    }
  }
  add_surface(
      mesh, grid, sides + 1, [&](int, int) { return material; }, tint);
}

}  // namespace

Mesh build_person(const MoverMaterials& materials, Random random) {
  Mesh mesh;
  const auto between = [&](double low, double high) { return static_cast<float>(random.uniform(low, high)); };
  const auto cloth = [&] {
    return std::array{materials.cloth_a, materials.cloth_b,
                      materials.cloth_c}[static_cast<std::size_t>(random.below(3))];
  };
  // clothes: mostly muted, sometimes bright
  const auto colour = [&] {
    constexpr std::array<std::array<float, 3>, 10> kColours{{{0.07f, 0.09f, 0.16f},
                                                             {0.05f, 0.05f, 0.055f},
                                                             {0.25f, 0.25f, 0.26f},
                                                             {0.8f, 0.8f, 0.78f},
                                                             {0.5f, 0.4f, 0.26f},
                                                             {0.16f, 0.2f, 0.11f},
                                                             {0.15f, 0.25f, 0.5f},
                                                             {0.55f, 0.08f, 0.07f},
                                                             {0.28f, 0.17f, 0.1f},
                                                             {0.65f, 0.5f, 0.1f}}};
    const auto& chosen = kColours[static_cast<std::size_t>(random.below(10))];
    const float bright = between(0.8, 1.2);
    return tint_of(bright * chosen[0], bright * chosen[1], bright * chosen[2]);
  };
  const std::uint16_t upper = cloth(), lower = cloth();
  const Tint upper_tint = colour(), lower_tint = shaded(colour(), 0.8f);
  const Tint skin = grey(between(0.55, 1.0)), hair = grey(between(0.4, 1.0));
  const float stout = between(0.9, 1.2), stride = between(0.16, 0.32);
  const bool has_coat = random.chance(0.35), has_skirt = !has_coat && random.chance(0.25), has_bag = random.chance(0.4);
  for (const float side : {-1.0f, 1.0f}) {
    const float step = side * stride;
    const Vector3f hip(0, side * 0.09f * stout, 0.93f);
    const Vector3f knee(0.55f * step + 0.06f, side * 0.09f, 0.5f);
    const Vector3f ankle(1.1f * step - (step < 0.0f ? 0.08f : 0.0f), side * 0.085f, step < 0.0f ? 0.15f : 0.09f);
    const Vector3f leg[] = {hip, 0.5f * (hip + knee), knee, 0.6f * knee + 0.4f * ankle, ankle};
    const float thick[] = {0.095f * stout, 0.085f * stout, 0.06f, 0.058f, 0.042f};
    add_bent_tube(mesh, leg, thick, 8, has_skirt ? materials.skin : lower, has_skirt ? skin : lower_tint);
    add_ellipsoid(mesh, ankle + Vector3f(0.07f, 0, -0.045f), {0.13f, 0.045f, 0.045f}, 8, 5, materials.shoes,
                  grey(between(0.4, 1.0)));
    const Vector3f shoulder(0, side * 0.2f * stout, 1.42f);
    const Vector3f elbow(-0.5f * step - 0.03f, side * 0.25f * stout, 1.15f);
    const Vector3f wrist(-1.0f * step + 0.1f, side * 0.22f * stout, 0.93f + 0.1f * std::abs(step));
    const Vector3f arm[] = {shoulder, 0.5f * (shoulder + elbow), elbow, wrist};
    const float arm_thick[] = {0.06f, 0.055f, 0.045f, 0.035f};
    add_bent_tube(mesh, arm, arm_thick, 7, upper, upper_tint);
    add_ellipsoid(mesh, shoulder - Vector3f(0, 0.03f * side, 0.0f), {0.07f, 0.085f, 0.06f}, 8, 5, upper, upper_tint);
    add_ellipsoid(mesh, wrist + Vector3f(0.02f, 0, -0.05f), {0.035f, 0.025f, 0.06f}, 7, 5, materials.skin, skin);
  }
  std::vector<Ring> torso{{{0, 0, 0.86f}, 0.11f, 0.165f},      {{0, 0, 0.97f}, 0.125f, 0.18f},
                          {{0, 0, 1.1f}, 0.105f, 0.155f},      {{0, 0, 1.27f}, 0.125f, 0.19f},
                          {{0, 0, 1.4f}, 0.11f, 0.205f},       {{-0.01f, 0, 1.455f}, 0.085f, 0.175f},
                          {{-0.01f, 0, 1.485f}, 0.065f, 0.1f}, {{-0.01f, 0, 1.5f}, 0.05f, 0.06f}};
  if (!has_coat) {  // the trousers' seat
    add_rings(mesh,
              {{{0.01f, 0, 0.78f}, 0.09f * stout, 0.13f * stout},
               {{0, 0, 0.86f}, 0.125f * stout, 0.18f * stout},
               {{0, 0, 0.98f}, 0.122f * stout, 0.178f * stout}},
              12, lower, lower_tint);
    torso.front() = {{0, 0, 0.93f}, 0.13f, 0.185f};
  }
  if (has_coat) torso.insert(torso.begin(), Ring{{0, 0, 0.6f}, 0.15f + 0.4f * stride, 0.2f});
  for (auto& ring : torso) {
    ring.deep *= stout;
    ring.wide *= stout;
  }
  add_rings(mesh, torso, 12, upper, upper_tint);
  if (has_skirt) {
    add_rings(
        mesh,
        {{{0, 0, 0.52f}, 0.16f + 0.5f * stride, 0.24f}, {{0, 0, 0.75f}, 0.18f, 0.21f}, {{0, 0, 1.0f}, 0.125f, 0.18f}},
        12, lower, lower_tint);
  }
  add_tube(mesh, {-0.005f, 0, 1.45f}, {0.01f, 0, 1.58f}, 0.055f, 0.05f, 8, materials.skin, skin);
  add_ellipsoid(mesh, {0.02f, 0, 1.66f}, {0.095f, 0.075f, 0.12f}, 12, 8, materials.skin, skin);
  add_ellipsoid(mesh, {0.115f, 0, 1.645f}, {0.02f, 0.015f, 0.025f}, 6, 4, materials.skin, skin);
  add_ellipsoid(mesh, {-0.012f, 0, 1.69f}, {0.1f, 0.086f, 0.11f}, 12, 7, materials.hair, hair);
  if (random.chance(0.35)) add_ellipsoid(mesh, {-0.06f, 0, 1.58f}, {0.06f, 0.09f, 0.16f}, 10, 6, materials.hair, hair);
  if (has_bag) {
    add_ellipsoid(mesh, {-0.2f * stout, 0, 1.25f}, {0.11f, 0.15f, 0.22f}, 10, 7, cloth(), colour());
  }
  return mesh;
}

}  // namespace panvo::simulated_world
