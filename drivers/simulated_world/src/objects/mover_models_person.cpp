// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <utility>

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

// Clothes: mostly muted, sometimes bright.
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

class PersonBuilder {
 public:
  // The members below are drawn in their order.
  PersonBuilder(const MoverMaterials& materials, Random random)
      : materials_(materials),
        random_(random),
        upper_(cloth()),
        lower_(cloth()),
        upper_tint_(colour()),
        lower_tint_(shaded(colour(), 0.8f)),
        skin_(grey(between(0.55, 1.0))),
        hair_(grey(between(0.4, 1.0))),
        stout_(between(0.9, 1.2)),
        stride_(between(0.16, 0.32)),
        has_coat_(random_.chance(0.35)),
        has_skirt_(!has_coat_ && random_.chance(0.25)),
        has_bag_(random_.chance(0.4)) {}

  Mesh build() {
    for (const float side : {-1.0f, 1.0f}) {
      add_leg(side);
      add_arm(side);
    }
    add_trunk();
    add_head();
    if (has_bag_) {
      add_ellipsoid(mesh_, {-0.2f * stout_, 0, 1.25f}, {0.11f, 0.15f, 0.22f}, 10, 7, cloth(), colour());
    }
    return std::move(mesh_);
  }

 private:
  float between(double low, double high) { return static_cast<float>(random_.uniform(low, high)); }

  std::uint16_t cloth() {
    return std::array{materials_.cloth_a, materials_.cloth_b,
                      materials_.cloth_c}[static_cast<std::size_t>(random_.below(3))];
  }

  Tint colour() {
    const auto& chosen = kColours[static_cast<std::size_t>(random_.below(10))];
    const float bright = between(0.8, 1.2);
    return tint_of(bright * chosen[0], bright * chosen[1], bright * chosen[2]);
  }

  void add_leg(float side) {
    const float step = side * stride_;
    const Vector3f hip(0, side * 0.09f * stout_, 0.93f);
    const Vector3f knee(0.55f * step + 0.06f, side * 0.09f, 0.5f);
    const Vector3f ankle(1.1f * step - (step < 0.0f ? 0.08f : 0.0f), side * 0.085f, step < 0.0f ? 0.15f : 0.09f);
    const Vector3f leg[] = {hip, 0.5f * (hip + knee), knee, 0.6f * knee + 0.4f * ankle, ankle};
    const float thick[] = {0.095f * stout_, 0.085f * stout_, 0.06f, 0.058f, 0.042f};
    add_bent_tube(mesh_, leg, thick, 8, has_skirt_ ? materials_.skin : lower_, has_skirt_ ? skin_ : lower_tint_);
    add_ellipsoid(mesh_, ankle + Vector3f(0.07f, 0, -0.045f), {0.13f, 0.045f, 0.045f}, 8, 5, materials_.shoes,
                  grey(between(0.4, 1.0)));
  }

  void add_arm(float side) {
    const float step = side * stride_;
    const Vector3f shoulder(0, side * 0.2f * stout_, 1.42f);
    const Vector3f elbow(-0.5f * step - 0.03f, side * 0.25f * stout_, 1.15f);
    const Vector3f wrist(-1.0f * step + 0.1f, side * 0.22f * stout_, 0.93f + 0.1f * std::abs(step));
    const Vector3f arm[] = {shoulder, 0.5f * (shoulder + elbow), elbow, wrist};
    const float arm_thick[] = {0.06f, 0.055f, 0.045f, 0.035f};
    add_bent_tube(mesh_, arm, arm_thick, 7, upper_, upper_tint_);
    add_ellipsoid(mesh_, shoulder - Vector3f(0, 0.03f * side, 0.0f), {0.07f, 0.085f, 0.06f}, 8, 5, upper_, upper_tint_);
    add_ellipsoid(mesh_, wrist + Vector3f(0.02f, 0, -0.05f), {0.035f, 0.025f, 0.06f}, 7, 5, materials_.skin, skin_);
  }

  void add_trunk() {
    std::vector<Ring> torso{{{0, 0, 0.86f}, 0.11f, 0.165f},      {{0, 0, 0.97f}, 0.125f, 0.18f},
                            {{0, 0, 1.1f}, 0.105f, 0.155f},      {{0, 0, 1.27f}, 0.125f, 0.19f},
                            {{0, 0, 1.4f}, 0.11f, 0.205f},       {{-0.01f, 0, 1.455f}, 0.085f, 0.175f},
                            {{-0.01f, 0, 1.485f}, 0.065f, 0.1f}, {{-0.01f, 0, 1.5f}, 0.05f, 0.06f}};
    if (!has_coat_) {  // the trousers' seat
      add_rings(mesh_,
                {{{0.01f, 0, 0.78f}, 0.09f * stout_, 0.13f * stout_},
                 {{0, 0, 0.86f}, 0.125f * stout_, 0.18f * stout_},
                 {{0, 0, 0.98f}, 0.122f * stout_, 0.178f * stout_}},
                12, lower_, lower_tint_);
      torso.front() = {{0, 0, 0.93f}, 0.13f, 0.185f};
    }
    if (has_coat_) torso.insert(torso.begin(), Ring{{0, 0, 0.6f}, 0.15f + 0.4f * stride_, 0.2f});
    for (auto& ring : torso) {
      ring.deep *= stout_;
      ring.wide *= stout_;
    }
    add_rings(mesh_, torso, 12, upper_, upper_tint_);
    if (has_skirt_) {
      add_rings(mesh_,
                {{{0, 0, 0.52f}, 0.16f + 0.5f * stride_, 0.24f},
                 {{0, 0, 0.75f}, 0.18f, 0.21f},
                 {{0, 0, 1.0f}, 0.125f, 0.18f}},
                12, lower_, lower_tint_);
    }
  }

  void add_head() {
    add_tube(mesh_, {-0.005f, 0, 1.45f}, {0.01f, 0, 1.58f}, 0.055f, 0.05f, 8, materials_.skin, skin_);
    add_ellipsoid(mesh_, {0.02f, 0, 1.66f}, {0.095f, 0.075f, 0.12f}, 12, 8, materials_.skin, skin_);
    add_ellipsoid(mesh_, {0.115f, 0, 1.645f}, {0.02f, 0.015f, 0.025f}, 6, 4, materials_.skin, skin_);
    add_ellipsoid(mesh_, {-0.012f, 0, 1.69f}, {0.1f, 0.086f, 0.11f}, 12, 7, materials_.hair, hair_);
    if (random_.chance(0.35))
      add_ellipsoid(mesh_, {-0.06f, 0, 1.58f}, {0.06f, 0.09f, 0.16f}, 10, 6, materials_.hair, hair_);
  }

  const MoverMaterials& materials_;
  Random random_;
  Mesh mesh_;
  std::uint16_t upper_, lower_;
  Tint upper_tint_, lower_tint_, skin_, hair_;
  float stout_, stride_;
  bool has_coat_, has_skirt_, has_bag_;
};

}  // namespace

Mesh build_person(const MoverMaterials& materials, Random random) { return PersonBuilder(materials, random).build(); }

}  // namespace panvo::simulated_world
