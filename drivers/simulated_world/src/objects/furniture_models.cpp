// SPDX-License-Identifier: Apache-2.0
#include "furniture_models.hpp"

#include <cmath>

#include "../shapes.hpp"

namespace panvo::simulated_world {

using Eigen::Vector3f;

FurnitureMaterials::FurnitureMaterials(const Palette& palette) {
  for (const auto& [number, name] : {std::pair{&metal_post, "metal_post"},
                                     {&metal_painted, "metal_painted"},
                                     {&lamp_head, "lamp_head"},
                                     {&sign_red, "sign_red"},
                                     {&sign_blue, "sign_blue"},
                                     {&sign_white, "sign_white"},
                                     {&bin_plastic, "bin_plastic"},
                                     {&wood_fence, "wood_fence"},
                                     {&concrete, "concrete"},
                                     {&stone_rubble, "stone_rubble"},
                                     {&brick_red, "brick_red"},
                                     {&ledge, "ledge"},
                                     {&tyre, "tyre"},
                                     {&poster, "poster"}}) {
    *number = palette.find(name);
  }
}

Mesh build_lamp_post(const FurnitureMaterials& materials, float height, bool is_lantern) {
  Mesh mesh;
  const Tint iron = is_lantern ? grey(0.16f) : grey(0.85f);
  const std::uint16_t metal = is_lantern ? materials.metal_painted : materials.metal_post;
  mesh.add_column({0, 0, -0.1f}, 0.11f, 0.1f, 0.9f, 10, metal, iron);
  mesh.add_column({0, 0, 0.8f}, 0.075f, 0.05f, height - 0.8f, 10, metal, iron);
  if (is_lantern) {
    mesh.add_column({0, 0, height}, 0.1f, 0.2f, 0.45f, 8, materials.lamp_head, grey(0.9f));
    mesh.add_column({0, 0, height + 0.45f}, 0.26f, 0.04f, 0.22f, 8, metal, iron);
    add_ellipsoid(mesh, {0, 0, height + 0.7f}, Vector3f::Constant(0.05f), 6, 4, metal, iron);
  } else {  // an arm over the road
    const Vector3f arm[] = {
        {0, 0, height - 0.05f}, {0, -0.25f, height + 0.3f}, {0, -0.9f, height + 0.45f}, {0, -1.5f, height + 0.5f}};
    const float thick[] = {0.05f, 0.045f, 0.04f, 0.04f};
    add_bent_tube(mesh, arm, thick, 8, metal, iron);
    add_ellipsoid(mesh, {0, -1.8f, height + 0.5f}, {0.15f, 0.42f, 0.08f}, 12, 6, metal, grey(0.7f));
    add_ellipsoid(mesh, {0, -1.85f, height + 0.465f}, {0.11f, 0.3f, 0.07f}, 10, 5, materials.lamp_head, grey(0.9f));
  }
  return mesh;
}

Mesh build_sign(const FurnitureMaterials& materials, SignKind kind) {
  Mesh mesh;
  add_tube(mesh, {0, 0, -0.1f}, {0, 0, 2.75f}, 0.03f, 0.03f, 8, materials.metal_post, grey(0.9f), true);
  const auto plate = [&](int corners, float radius, float turn, float z, std::uint16_t material, float out, Tint tint) {
    std::vector<Vertex> front, back;
    for (int i = 0; i < corners; ++i) {
      const float angle = turn + 2.0f * kPi * static_cast<float>(i) / static_cast<float>(corners);
      const Vector3f place(radius * std::cos(angle), -out, z + radius * std::sin(angle));
      // the picture, one period of 0.6 m, over the plate
      const Eigen::Vector2f uv(0.3f + 0.3f * std::cos(angle), 0.3f + 0.3f * std::sin(angle));
      front.push_back({place, -Vector3f::UnitY(), uv, tint});
      back.insert(back.begin(), {place + Vector3f(0, 0.015f, 0), Vector3f::UnitY(), uv, grey(0.6f)});
    }
    mesh.add_polygon(front, material);
    mesh.add_polygon(back, materials.metal_post);
  };
  switch (kind) {
    case SignKind::kStop:
      plate(8, 0.4f, kPi / 8.0f, 2.4f, materials.sign_red, 0.045f, {});
      break;
    case SignKind::kSquare:
      plate(4, 0.42f, kPi / 4.0f, 2.4f, materials.sign_blue, 0.045f, {});
      break;
    case SignKind::kPlace:
      add_block(mesh, {-0.65f, -0.06f, 2.1f}, {0.65f, -0.03f, 2.6f}, materials.sign_blue);
      add_tube(mesh, {0.5f, 0, -0.1f}, {0.5f, 0, 2.65f}, 0.03f, 0.03f, 8, materials.metal_post, grey(0.9f), true);
      break;
    case SignKind::kArrow:
      add_block(mesh, {-0.1f, -0.05f, 2.25f}, {0.9f, -0.03f, 2.45f}, materials.sign_white);
      add_block(mesh, {-0.8f, 0.03f, 2.5f}, {0.1f, 0.05f, 2.7f}, materials.sign_white);
      plate(4, 0.42f, 0.0f, 1.75f, materials.sign_blue, 0.045f, {});
      break;
  }
  return mesh;
}

Mesh build_litter_bin(const FurnitureMaterials& materials) {
  Mesh mesh;
  add_tube(mesh, {0, 0, -0.05f}, {0, 0, 1.1f}, 0.03f, 0.03f, 6, materials.metal_post, grey(0.8f), true);
  mesh.add_column({0, -0.22f, 0.35f}, 0.18f, 0.21f, 0.55f, 12, materials.metal_painted, tint_of(0.25f, 0.4f, 0.25f));
  mesh.add_column({0, -0.22f, 0.9f}, 0.22f, 0.2f, 0.05f, 12, materials.bin_plastic, grey(0.7f));
  return mesh;
}

Mesh build_wheelie_bin(const FurnitureMaterials& materials) {
  Mesh mesh;
  const Vector3f low[] = {{-0.24f, -0.28f, 0.1f}, {0.24f, -0.28f, 0.1f}, {0.24f, 0.25f, 0.1f}, {-0.24f, 0.25f, 0.1f}};
  const Vector3f high[] = {
      {-0.29f, -0.36f, 0.98f}, {0.29f, -0.36f, 0.98f}, {0.29f, 0.3f, 0.98f}, {-0.29f, 0.3f, 0.98f}};
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    mesh.add_quad(low[i], low[next], high[next], high[i], materials.bin_plastic);
  }
  add_block(mesh, {-0.31f, -0.4f, 0.98f}, {0.31f, 0.33f, 1.05f}, materials.bin_plastic, grey(0.85f));
  add_tube(mesh, {-0.25f, 0.36f, 1.0f}, {0.25f, 0.36f, 1.0f}, 0.018f, 0.018f, 6, materials.bin_plastic);
  for (const float x : {-0.26f, 0.22f}) {
    add_tube(mesh, {x, 0.27f, 0.11f}, {x + 0.05f, 0.27f, 0.11f}, 0.11f, 0.11f, 12, materials.tyre, grey(0.8f), true);
  }
  return mesh;
}

Mesh build_bench(const FurnitureMaterials& materials) {
  Mesh mesh;
  for (const float y : {-0.22f, -0.09f, 0.04f})
    add_block(mesh, {-0.85f, y, 0.42f}, {0.85f, y + 0.1f, 0.46f}, materials.wood_fence, grey(0.9f));
  for (const float z : {0.58f, 0.72f})
    add_block(mesh, {-0.85f, 0.2f, z}, {0.85f, 0.24f, z + 0.1f}, materials.wood_fence, grey(0.9f));
  for (const float x : {-0.65f, 0.65f}) {
    for (const float y : {-0.18f, 0.16f})
      add_block(mesh, {x - 0.03f, y - 0.03f, -0.05f}, {x + 0.03f, y + 0.03f, 0.42f}, materials.metal_painted,
                grey(0.2f));
    add_tube(mesh, {x, 0.16f, 0.4f}, {x, 0.27f, 0.85f}, 0.025f, 0.025f, 6, materials.metal_painted, grey(0.2f));
    add_tube(mesh, {x, -0.2f, 0.64f}, {x, 0.2f, 0.66f}, 0.022f, 0.022f, 6, materials.metal_painted, grey(0.2f));
    add_tube(mesh, {x, -0.2f, 0.4f}, {x, -0.2f, 0.64f}, 0.022f, 0.022f, 6, materials.metal_painted, grey(0.2f));
  }
  return mesh;
}

Mesh build_bollard(const FurnitureMaterials& materials) {
  Mesh mesh;
  mesh.add_column({0, 0, -0.05f}, 0.075f, 0.065f, 0.85f, 10, materials.metal_painted, grey(0.22f));
  mesh.add_column({0, 0, 0.62f}, 0.078f, 0.076f, 0.1f, 10, materials.sign_white, grey(1.0f));
  add_ellipsoid(mesh, {0, 0, 0.8f}, {0.068f, 0.068f, 0.06f}, 10, 4, materials.metal_painted, grey(0.22f));
  return mesh;
}

Mesh build_hydrant(const FurnitureMaterials& materials) {
  Mesh mesh;
  const Tint red = tint_of(0.9f, 0.12f, 0.08f);
  mesh.add_column({0, 0, -0.05f}, 0.16f, 0.15f, 0.12f, 10, materials.metal_painted, red);
  mesh.add_column({0, 0, 0.05f}, 0.11f, 0.11f, 0.55f, 10, materials.metal_painted, red);
  add_ellipsoid(mesh, {0, 0, 0.6f}, {0.13f, 0.13f, 0.13f}, 10, 6, materials.metal_painted, red);
  add_tube(mesh, {-0.2f, 0, 0.42f}, {0.2f, 0, 0.42f}, 0.06f, 0.06f, 8, materials.metal_painted, red, true);
  add_tube(mesh, {0, 0, 0.42f}, {0, -0.2f, 0.42f}, 0.075f, 0.075f, 8, materials.metal_post, grey(0.8f), true);
  return mesh;
}

Mesh build_cabinet(const FurnitureMaterials& materials) {
  Mesh mesh;
  const Tint paint = tint_of(0.55f, 0.58f, 0.52f);
  add_block(mesh, {-0.5f, -0.18f, -0.1f}, {0.5f, 0.18f, 0.12f}, materials.concrete);
  add_block(mesh, {-0.48f, -0.16f, 0.12f}, {0.48f, 0.16f, 1.2f}, materials.metal_painted, paint);
  add_block(mesh, {-0.52f, -0.2f, 1.2f}, {0.52f, 0.2f, 1.26f}, materials.metal_painted, shaded(paint, 0.9f));
  add_block(mesh, {-0.006f, -0.166f, 0.15f}, {0.006f, -0.15f, 1.18f}, materials.metal_painted, grey(0.1f));
  add_block(mesh, {0.04f, -0.19f, 0.6f}, {0.07f, -0.15f, 0.78f}, materials.metal_post, grey(0.6f));
  add_block(mesh, {-0.4f, -0.17f, 0.7f}, {-0.1f, -0.15f, 1.05f}, materials.poster);
  return mesh;
}

Mesh build_bicycle_stand(const FurnitureMaterials& materials, Random random) {
  Mesh mesh;
  for (int stand = 0; stand < 4; ++stand) {
    const float x = 0.75f * (static_cast<float>(stand) - 1.5f);
    const Vector3f hoop[] = {{x, -0.35f, -0.05f}, {x, -0.35f, 0.65f}, {x, -0.25f, 0.8f},
                             {x, 0.25f, 0.8f},    {x, 0.35f, 0.65f},  {x, 0.35f, -0.05f}};
    const float thick[] = {0.025f, 0.025f, 0.025f, 0.025f, 0.025f, 0.025f};
    add_bent_tube(mesh, hoop, thick, 6, materials.metal_post, grey(0.9f));
    if (random.chance(0.3)) continue;
    const float bike = x + 0.12f, lean = static_cast<float>(random.uniform(-0.08, 0.08));
    const Tint paint =
        tint_of(static_cast<float>(random.uniform(0.05, 0.9)), static_cast<float>(random.uniform(0.05, 0.7)),
                static_cast<float>(random.uniform(0.05, 0.8)));
    const auto at = [&](float y, float z) { return Vector3f(bike + lean * z, y, z); };
    const auto bar = [&](const Vector3f& from, const Vector3f& to, float radius) {
      add_tube(mesh, from, to, radius, radius, 5, materials.metal_painted, paint);
    };
    for (const float hub : {-0.5f, 0.5f}) {
      constexpr int kParts = 14;
      for (int i = 0; i < kParts; ++i) {
        const float a = 2.0f * kPi * static_cast<float>(i) / kParts,
                    b = 2.0f * kPi * static_cast<float>(i + 1) / kParts;
        add_tube(mesh, at(hub + 0.33f * std::cos(a), 0.34f + 0.33f * std::sin(a)),
                 at(hub + 0.33f * std::cos(b), 0.34f + 0.33f * std::sin(b)), 0.02f, 0.02f, 4, materials.tyre,
                 grey(0.7f));
        if (i % 2 == 0)
          add_tube(mesh, at(hub, 0.34f), at(hub + 0.32f * std::cos(a), 0.34f + 0.32f * std::sin(a)), 0.003f, 0.003f, 3,
                   materials.metal_post, grey(0.9f));
      }
    }
    bar(at(-0.5f, 0.34f), at(-0.05f, 0.3f), 0.012f);
    bar(at(-0.5f, 0.34f), at(-0.18f, 0.78f), 0.01f);
    bar(at(-0.05f, 0.3f), at(-0.22f, 0.9f), 0.016f);
    bar(at(-0.05f, 0.3f), at(0.36f, 0.72f), 0.018f);
    bar(at(-0.17f, 0.76f), at(0.34f, 0.8f), 0.016f);
    bar(at(0.5f, 0.34f), at(0.33f, 0.95f), 0.016f);
    add_tube(mesh, at(0.3f, 0.97f) - Vector3f(0.26f, 0, 0), at(0.3f, 0.97f) + Vector3f(0.26f, 0, 0), 0.012f, 0.012f, 5,
             materials.metal_post);
    add_ellipsoid(mesh, at(-0.24f, 0.92f), {0.07f, 0.13f, 0.03f}, 8, 4, materials.bin_plastic, grey(0.6f));
  }
  return mesh;
}

Mesh build_notice_board(const FurnitureMaterials& materials) {
  Mesh mesh;
  for (const float x : {-0.95f, 0.95f})
    add_tube(mesh, {x, 0, -0.1f}, {x, 0, 2.1f}, 0.04f, 0.04f, 8, materials.metal_painted, grey(0.3f), true);
  add_block(mesh, {-0.9f, -0.03f, 0.8f}, {0.9f, 0.03f, 2.0f}, materials.metal_painted, grey(0.35f));
  for (const float x : {-0.82f, -0.25f, 0.32f}) {
    const float top = x < -0.5f ? 1.9f : 1.8f;
    mesh.add_quad({x, -0.035f, 0.9f}, {x + 0.5f, -0.035f, 0.9f}, {x + 0.5f, -0.035f, top}, {x, -0.035f, top},
                  materials.poster, {0.4f * x, 0.0f});
  }
  add_block(mesh, {-1.05f, -0.2f, 2.05f}, {1.05f, 0.2f, 2.1f}, materials.metal_painted, grey(0.3f));
  return mesh;
}

Mesh build_fence(const FurnitureMaterials& materials, FenceKind kind, Random random) {
  Mesh mesh;
  switch (kind) {
    case FenceKind::kSlats: {
      add_block(mesh, {-1.05f, -0.05f, -0.2f}, {-0.95f, 0.05f, 1.15f}, materials.wood_fence, grey(0.75f));
      for (const float z : {0.3f, 0.85f})
        add_block(mesh, {-1.0f, 0.0f, z}, {1.0f, 0.04f, z + 0.08f}, materials.wood_fence, grey(0.8f));
      for (int i = 0; i < 13; ++i) {
        const float x = -0.93f + 0.154f * static_cast<float>(i);
        const float top = 1.05f + static_cast<float>(random.uniform(-0.015, 0.015));
        const Tint tint = grey(static_cast<float>(random.uniform(0.8, 1.0)));
        add_block(mesh, {x, -0.025f, 0.05f}, {x + 0.095f, 0.0f, top}, materials.wood_fence, tint);
      }
      break;
    }
    case FenceKind::kBars: {
      const Tint iron = grey(0.14f);
      add_block(mesh, {-1.0f, -0.12f, -0.3f}, {1.0f, 0.12f, 0.22f}, materials.concrete, grey(0.85f));
      add_block(mesh, {-1.04f, -0.04f, 0.2f}, {-0.96f, 0.04f, 1.35f}, materials.metal_painted, iron);
      for (const float z : {0.32f, 1.15f})
        add_block(mesh, {-1.0f, -0.015f, z}, {1.0f, 0.015f, z + 0.035f}, materials.metal_painted, iron);
      for (int i = 1; i < 16; ++i) {
        const float x = -1.0f + 0.125f * static_cast<float>(i);
        add_tube(mesh, {x, 0, 0.24f}, {x, 0, 1.28f}, 0.011f, 0.008f, 4, materials.metal_painted, iron);
      }
      break;
    }
    case FenceKind::kWall:
    case FenceKind::kBrickWall: {
      const bool is_brick = kind == FenceKind::kBrickWall;
      const float height = is_brick ? 1.1f : 0.75f;
      for (int part = 0; part < 4; ++part) {  // in parts, for shading per vertex
        const float x = -1.0f + 0.5f * static_cast<float>(part);
        add_block(mesh, {x, -0.15f, -0.4f}, {x + 0.5f, 0.15f, 0.3f},
                  is_brick ? materials.brick_red : materials.stone_rubble, grey(0.8f));
        add_block(mesh, {x, -0.15f, 0.3f}, {x + 0.5f, 0.15f, height},
                  is_brick ? materials.brick_red : materials.stone_rubble, grey(0.95f));
      }
      // textures continue from part to part
      for (auto& vertex : mesh.vertices) {
        if (std::abs(vertex.normal.y()) > 0.5f)
          vertex.uv = {-vertex.normal.y() * vertex.position.x(), vertex.position.z()};
      }
      add_block(mesh, {-1.0f, -0.2f, height}, {1.0f, 0.2f, height + 0.08f}, materials.ledge, grey(0.85f));
      break;
    }
  }
  return mesh;
}

}  // namespace panvo::simulated_world
