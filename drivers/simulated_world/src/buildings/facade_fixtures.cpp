// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "../shapes.hpp"
#include "facade.hpp"

namespace panvo::simulated_world {
namespace {

constexpr float kStep = 0.15f;  // height of a stair, m

}  // namespace

void add_wall_box(Mesh& mesh, const WallFrame& frame, float u0, float u1, float z0, float z1, float behind, float front,
                  std::uint16_t material, Tint tint) {
  constexpr float kAboveEyes = 3.2f, kBelowEyes = 0.6f;  // m: tops above and undersides below are out of view
  const auto at = [&](float u, float out, float z) { return frame.at(u, out, z); };
  const Eigen::Vector2f low(u0, z0);
  mesh.add_quad(at(u0, front, z0), at(u1, front, z0), at(u1, front, z1), at(u0, front, z1), material, low, tint);
  mesh.add_quad(at(u1, front, z0), at(u1, behind, z0), at(u1, behind, z1), at(u1, front, z1), material, low, tint);
  mesh.add_quad(at(u0, behind, z0), at(u0, front, z0), at(u0, front, z1), at(u0, behind, z1), material, low, tint);
  if (z1 < kAboveEyes) {
    mesh.add_quad(at(u0, front, z1), at(u1, front, z1), at(u1, behind, z1), at(u0, behind, z1), material, low, tint);
  }
  if (z0 > kBelowEyes) {
    mesh.add_quad(at(u0, behind, z0), at(u1, behind, z0), at(u1, front, z0), at(u0, front, z0), material, low, tint);
  }
}

float entry_height(const FacadeStyle& style) { return kStep * std::floor(style.base_height / kStep); }

void build_entrance(const FacadeStyle& style, const BuildingMaterials& materials, const WallFrame& frame,
                    const Opening& opening, Random& lights, Mesh& mesh) {
  const float left = opening.left - 0.25f, right = opening.right + 0.25f;
  const int steps = static_cast<int>(std::lround(entry_height(style) / kStep));
  for (int step = 0; step < steps; ++step) {
    const float reach = 0.35f + 0.3f * static_cast<float>(steps - step);
    add_wall_box(mesh, frame, left - 0.1f, right + 0.1f, -frame.depth_below, kStep * static_cast<float>(step + 1),
                 -0.2f, reach, materials.concrete, grey(0.9f));
  }
  const float top = opening.top + opening.rise;
  if (style.use == BuildingUse::kInstitute || lights.chance(0.45)) {  // a canopy
    const float reach = style.use == BuildingUse::kInstitute ? 2.0f : 1.0f;
    add_wall_box(mesh, frame, left - 0.3f, right + 0.3f, top + 0.25f, top + 0.4f, 0.0f, reach, style.trim,
                 style.trim_tint);
    if (reach > 1.5f) {
      for (const float u : {left - 0.15f, right + 0.15f}) {
        add_tube(mesh, frame.at(u, reach - 0.2f, 0.0f), frame.at(u, reach - 0.2f, top + 0.3f), 0.06f, 0.06f, 8,
                 materials.metal_post);
      }
    }
  } else {
    add_wall_box(mesh, frame, opening.middle() - 0.1f, opening.middle() + 0.1f, top + 0.22f, top + 0.42f, 0.0f, 0.22f,
                 materials.lamp_head, grey(0.9f));
  }
  const float beside = right + 0.15f;
  if (beside + 0.5f < frame.width) {
    add_wall_box(mesh, frame, beside, beside + 0.4f, opening.bottom + 1.3f, opening.bottom + 1.6f, 0.0f, 0.03f,
                 lights.chance(0.5) ? materials.sign_white : materials.sign_blue, grey(1.0f));
    if (lights.chance(0.3)) {
      add_wall_box(mesh, frame, beside, beside + 0.6f, opening.bottom + 0.35f, opening.bottom + 1.2f, 0.0f, 0.02f,
                   materials.poster, grey(1.0f));
    }
  }
}

void build_shop_sign(const FacadeStyle& style, const BuildingMaterials& materials, const WallFrame& frame,
                     const Opening& opening, Random& lights, Mesh& mesh) {
  const double kind = lights.uniform();
  const Tint tint = tint_of(static_cast<float>(lights.uniform(0.3, 1.0)), static_cast<float>(lights.uniform(0.3, 1.0)),
                            static_cast<float>(lights.uniform(0.3, 1.0)));
  add_wall_box(mesh, frame, opening.left - 0.1f, opening.right + 0.1f, opening.top + 0.1f, opening.top + 0.6f, 0.0f,
               0.1f, kind < 0.5 ? materials.sign_white : materials.metal_painted, tint);
  if (kind > 0.6) {  // an awning
    mesh.add_quad(frame.at(opening.left - 0.1f, 1.2f, opening.top - 0.35f),
                  frame.at(opening.right + 0.1f, 1.2f, opening.top - 0.35f),
                  frame.at(opening.right + 0.1f, 0.02f, opening.top + 0.1f),
                  frame.at(opening.left - 0.1f, 0.02f, opening.top + 0.1f), materials.curtain_light,
                  Eigen::Vector2f::Zero(), tint);
  }
  if (kind < 0.35) {
    add_wall_box(mesh, frame, opening.left + 0.3f, opening.left + 0.9f, opening.bottom + 0.5f, opening.bottom + 1.35f,
                 -style.recess + 0.005f, -style.recess + 0.015f, materials.poster, grey(1.0f));
  }
}

void build_balcony(const FacadeStyle& style, const BuildingMaterials& materials, const WallFrame& frame,
                   const Opening& opening, bool is_lowest, Mesh& mesh) {
  const float left = opening.left - 0.4f, right = opening.right + 0.4f;
  const float z = opening.bottom - 0.02f;
  const float reach = is_lowest ? 1.1f : 0.9f;
  add_wall_box(mesh, frame, left, right, z - 0.16f, z, 0.0f, reach, style.trim, style.trim_tint);
  const Tint iron = style.use == BuildingUse::kHouse ? style.shutter_tint : grey(0.2f);
  const auto rail = [&](float u, float out) {
    add_tube(mesh, frame.at(u, out, z), frame.at(u, out, z + 0.95f), 0.012f, 0.012f, 3, materials.metal_painted, iron);
  };
  const int count = static_cast<int>((right - left) / 0.2f);
  for (int i = 0; i <= count; ++i)
    rail(left + 0.04f + (right - left - 0.08f) * static_cast<float>(i) / static_cast<float>(count), reach - 0.05f);
  for (float out = 0.2f; out < reach - 0.1f; out += 0.25f) {
    rail(left + 0.04f, out);
    rail(right - 0.04f, out);
  }
  add_wall_box(mesh, frame, left, right, z + 0.93f, z + 0.98f, reach - 0.08f, reach - 0.02f, materials.metal_painted,
               iron);
  for (const float u : {left + 0.02f, right - 0.06f}) {
    add_wall_box(mesh, frame, u, u + 0.04f, z + 0.93f, z + 0.98f, 0.0f, reach - 0.05f, materials.metal_painted, iron);
  }
  for (const float u : {left + 0.1f, right - 0.25f}) {  // brackets
    add_wall_box(mesh, frame, u, u + 0.15f, z - 0.5f, z - 0.16f, 0.0f, 0.35f, style.trim, style.trim_tint);
  }
}

void build_arch_band(const FacadeStyle& style, const WallFrame& frame, const Opening& opening, Mesh& mesh) {
  const auto edge = outline(opening);
  const Eigen::Vector2f centre(opening.middle(), opening.top);
  for (std::size_t i = 1; i + 2 < edge.size(); ++i) {
    const auto raised = [&](const Eigen::Vector2f& point) -> Eigen::Vector2f {
      return point + 0.18f * (point - centre + Eigen::Vector2f(0, 0.05f)).normalized();
    };
    const Eigen::Vector2f a = edge[i], b = edge[i + 1], c = raised(b), d = raised(a);
    mesh.add_quad(frame.at(a.x(), 0.05f, a.y()), frame.at(b.x(), 0.05f, b.y()), frame.at(c.x(), 0.05f, c.y()),
                  frame.at(d.x(), 0.05f, d.y()), style.trim, {a.x(), a.y()}, style.trim_tint);
    mesh.add_quad(frame.at(d.x(), 0.05f, d.y()), frame.at(c.x(), 0.05f, c.y()), frame.at(c.x(), 0.0f, c.y()),
                  frame.at(d.x(), 0.0f, d.y()), style.trim, {a.x(), a.y()}, style.trim_tint);
  }
}

void build_air_conditioner(const BuildingMaterials& materials, const WallFrame& frame, const Opening& opening,
                           Mesh& mesh) {
  add_wall_box(mesh, frame, opening.right + 0.15f, opening.right + 0.9f, opening.bottom - 0.5f, opening.bottom + 0.05f,
               0.08f, 0.38f, materials.metal_painted, grey(0.85f));
  add_wall_box(mesh, frame, opening.right + 0.22f, opening.right + 0.62f, opening.bottom - 0.42f,
               opening.bottom - 0.03f, 0.3f, 0.385f, materials.metal_painted, grey(0.25f));
}

void build_ivy(const FacadeStyle& style, const BuildingMaterials& materials, const WallFrame& frame, Random& lights,
               Mesh& mesh) {
  const float middle = static_cast<float>(lights.uniform(0.0, 1.0)) * frame.width;
  const float height = static_cast<float>(lights.uniform(0.5, 0.95)) * wall_height(style);
  const float half_width = static_cast<float>(lights.uniform(1.2, 3.0));
  const int cards = static_cast<int>(10.0f * half_width * height);
  for (int i = 0; i < std::min(cards, 220); ++i) {
    const float z = height * static_cast<float>(std::pow(lights.uniform(), 1.3));
    const float spread = half_width * (1.05f - 0.7f * z / height);
    const float u = middle + spread * static_cast<float>(lights.uniform(-1.0, 1.0));
    if (u < 0.2f || u > frame.width - 0.2f) continue;
    const float size = static_cast<float>(lights.uniform(0.25, 0.5));
    const float turn = static_cast<float>(lights.uniform(0.0, 6.28));
    const float lean = static_cast<float>(lights.uniform(-0.3, 0.3));
    const Eigen::Vector3f up(0, 0, 1);
    const Eigen::Vector3f right = size * (std::cos(turn) * frame.right + std::sin(turn) * up + lean * frame.outwards);
    const Eigen::Vector3f rise = size * (-std::sin(turn) * frame.right + std::cos(turn) * up + 0.3f * frame.outwards);
    const float brightness = static_cast<float>(lights.uniform(0.5, 0.95));
    add_card(mesh, frame.at(u, static_cast<float>(lights.uniform(0.06, 0.22)), z), right, rise,
             (frame.outwards + 0.5f * up + 0.3f * right).normalized(), materials.leaves_period_m, materials.leaves,
             tint_of(0.8f * brightness, brightness, 0.75f * brightness));
  }
}

}  // namespace panvo::simulated_world
