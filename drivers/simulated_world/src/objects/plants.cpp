// SPDX-License-Identifier: Apache-2.0
#include "plants.hpp"

#include <cmath>

#include "../shapes.hpp"

namespace panvo::simulated_world {
namespace {

using Eigen::Vector3f;

Vector3f direction(Random& random) {
  const float z = between(random, -1.0, 1.0), angle = between(random, 0.0, 2.0 * kPi);
  const float flat = std::sqrt(1.0f - z * z);
  return {flat * std::cos(angle), flat * std::sin(angle), z};
}

/// A ball of leaves.
struct Cluster {
  Vector3f centre, radii;
};

struct Foliage {
  std::uint16_t material;
  float period_m;
  float card_m;        ///< edge length of a card
  float droop = 0.0f;  ///< 0: random orientation of the cards; 1: they hang
};

/// Distributes cards over the clusters, shaded like the crown's hull: brighter outside and at the top.
void add_crown(Mesh& mesh, const std::vector<Cluster>& clusters, const Vector3f& crown, float crown_radius, int cards,
               const Foliage& foliage, Random& random) {
  float total = 0.0f;
  for (const auto& cluster : clusters) total += cluster.radii.squaredNorm();
  for (int i = 0; i < cards; ++i) {
    float draw = total * between(random, 0.0, 1.0);
    std::size_t chosen = 0;
    while (chosen + 1 < clusters.size() && draw > clusters[chosen].radii.squaredNorm())
      draw -= clusters[chosen++].radii.squaredNorm();
    const Cluster& cluster = clusters[chosen];
    const Vector3f outwards = direction(random);
    const float reach = std::cbrt(between(random, 0.3, 1.0));
    const Vector3f place = cluster.centre + reach * outwards.cwiseProduct(cluster.radii);
    const Vector3f from_crown = (place - crown) / crown_radius;
    Vector3f normal = (0.75f * from_crown + 0.4f * outwards + Vector3f(0, 0, 0.25f)).normalized();
    // cards are roughly perpendicular to the outward direction, so that the crown looks closed
    Vector3f facing = (normal + 0.9f * direction(random)).normalized();
    if (foliage.droop > 0.0f) facing = (facing - foliage.droop * facing.z() * Vector3f::UnitZ()).normalized();
    Vector3f right = facing.cross(Vector3f::UnitZ());
    right = right.norm() > 0.05f ? right.normalized() : Vector3f::UnitX();
    const Vector3f up = right.cross(-facing);
    const float spin = between(random, 0.0, 2.0 * kPi) * (1.0f - foliage.droop);
    const float half = 0.5f * foliage.card_m * between(random, 0.75, 1.3);
    const Vector3f along = half * (std::cos(spin) * right + std::sin(spin) * up),
                   across = half * (std::cos(spin) * up - std::sin(spin) * right);
    const float height = std::clamp(0.5f + 0.5f * from_crown.z(), 0.0f, 1.0f);
    const float depth = std::clamp(from_crown.norm(), 0.0f, 1.0f);
    const float brightness = (0.45f + 0.3f * depth + 0.25f * height) * between(random, 0.85, 1.0);
    const float warm = between(random, 0.85, 1.0);
    add_card(mesh, place, along, across, normal, foliage.period_m, foliage.material,
             tint_of(brightness * warm, brightness, brightness * warm * 0.95f));
  }
}

/// A slightly bent trunk from the origin to `top`.
void add_trunk(Mesh& mesh, const Vector3f& top, float radius, std::uint16_t material, Tint tint, Random& random) {
  const Vector3f bend(between(random, -0.25, 0.25), between(random, -0.25, 0.25), 0.0f);
  const Vector3f points[] = {
      {0, 0, -0.3f}, {0, 0, 0.25f}, 0.15f * top + 0.3f * bend, 0.45f * top + bend, 0.75f * top + 0.6f * bend, top};
  const float radii[] = {1.7f * radius, 1.15f * radius, radius, 0.85f * radius, 0.6f * radius, 0.25f * radius};
  add_bent_tube(mesh, points, radii, 9, material, tint);
}

void add_branch(Mesh& mesh, const Vector3f& from, const Vector3f& to, float radius, std::uint16_t material, Tint tint) {
  const Vector3f middle = 0.5f * (from + to) + 0.12f * (to - from).norm() * Vector3f(0, 0, -0.5f);
  const Vector3f points[] = {from, middle, to};
  const float radii[] = {radius, 0.65f * radius, 0.2f * radius};
  add_bent_tube(mesh, points, radii, 5, material, tint);
}

struct BroadShape {
  float height, trunk, crown_radius, crown_height;  ///< trunk: height up to the crown
  int clusters, cards;
  float trunk_radius;
};

Mesh build_broad(const BroadShape& shape, const Foliage& foliage, std::uint16_t bark, Tint bark_tint, Random& random) {
  Mesh mesh;
  const Vector3f crown(0, 0, shape.trunk + 0.45f * shape.crown_height);
  add_trunk(mesh, {between(random, -0.2, 0.2), between(random, -0.2, 0.2), shape.height * 0.85f}, shape.trunk_radius,
            bark, bark_tint, random);
  std::vector<Cluster> clusters;
  const float half_height = 0.5f * shape.crown_height;
  clusters.push_back({crown, Vector3f(0.7f * shape.crown_radius, 0.7f * shape.crown_radius, 0.8f * half_height)});
  const float start = between(random, 0.0, 2.0 * kPi);
  for (int i = 0; i < shape.clusters; ++i) {
    // in a spiral from bottom to top
    const float angle = start + 2.4f * static_cast<float>(i);
    const float share = (static_cast<float>(i) + 0.5f) / static_cast<float>(shape.clusters);
    const float level = 1.7f * share - 0.8f;
    const float ring = std::sqrt(std::max(0.05f, 1.0f - level * level)) * between(random, 0.5, 0.72);
    const Vector3f centre = crown + Vector3f(shape.crown_radius * ring * std::cos(angle),
                                             shape.crown_radius * ring * std::sin(angle), level * 0.75f * half_height);
    const float size = shape.crown_radius * between(random, 0.32, 0.5);
    clusters.push_back({centre, Vector3f(size, size, 0.8f * size)});
    add_branch(mesh, {0, 0, std::max(0.6f * shape.trunk, centre.z() - 0.6f * shape.crown_radius)}, centre,
               0.35f * shape.trunk_radius, bark, bark_tint);
  }
  add_crown(mesh, clusters, crown - Vector3f(0, 0, 0.2f * half_height), shape.crown_radius, shape.cards, foliage,
            random);
  return mesh;
}

/// A conifer: whorls of branches, each with several overlapping cards that droop outwards.
Mesh build_conifer(float height, float radius, float bare, int whorls, const PlantMaterials& materials,
                   Random& random) {
  Mesh mesh;
  add_trunk(mesh, {0, 0, height}, 0.02f * height, materials.bark, grey(0.85f), random);
  for (int whorl = 0; whorl < whorls; ++whorl) {
    const float share = static_cast<float>(whorl) / static_cast<float>(whorls);
    const float z = bare + (height - bare) * share;
    const float reach = radius * std::pow(1.0f - share, 0.8f) + 0.25f;
    const int branches = std::max(4, static_cast<int>(std::lround(9.0f * (1.0f - 0.6f * share))));
    const float turn = between(random, 0.0, 2.0 * kPi);
    for (int i = 0; i < branches; ++i) {
      const float angle =
          turn + 2.0f * kPi * (static_cast<float>(i) + between(random, -0.25, 0.25)) / static_cast<float>(branches);
      const Vector3f out(std::cos(angle), std::sin(angle), 0), side(-std::sin(angle), std::cos(angle), 0);
      const float length = reach * between(random, 0.8, 1.1);
      const float sink = between(random, 0.15, 0.4);
      const int cards = length > 1.1f ? 2 : 1;
      for (int card = 0; card < cards; ++card) {
        const float half = 0.55f * length / static_cast<float>(cards) + 0.12f;
        const float middle = length * (static_cast<float>(card) + 0.5f) / static_cast<float>(cards);
        const Vector3f along = (out - sink * Vector3f::UnitZ()).normalized();
        const Vector3f across = (side + between(random, -0.5, 0.5) * Vector3f::UnitZ()).normalized();
        const Vector3f normal = (0.8f * out + Vector3f(0, 0, 0.55f)).normalized();
        const float brightness =
            (0.5f + 0.5f * middle / (reach + 0.01f)) * between(random, 0.8, 1.0) * (0.8f + 0.2f * share);
        add_card(mesh, Vector3f(0, 0, z) + middle * along, half * along, std::min(half, 0.6f) * across, normal,
                 materials.needle_period_m, materials.leaves_needle, grey(brightness));
      }
    }
  }
  add_card(mesh, {0, 0, height - 0.2f}, {0.3f, 0, 0}, {0, 0, 0.5f}, Vector3f(0, -1, 0), materials.needle_period_m,
           materials.leaves_needle, grey(0.9f));
  add_card(mesh, {0, 0, height - 0.2f}, {0, 0.3f, 0}, {0, 0, 0.5f}, Vector3f(1, 0, 0), materials.needle_period_m,
           materials.leaves_needle, grey(0.9f));
  return mesh;
}

}  // namespace

PlantMaterials::PlantMaterials(const Palette& palette) {
  for (const auto& [number, name] : {std::pair{&bark, "bark"},
                                     {&leaves_broad, "leaves_broad"},
                                     {&leaves_small, "leaves_small"},
                                     {&leaves_needle, "leaves_needle"},
                                     {&hedge, "hedge"},
                                     {&flowers, "flowers"},
                                     {&soil, "soil"}}) {
    *number = palette.find(name);
  }
  broad_period_m = palette.materials()[leaves_broad].period_m;
  small_period_m = palette.materials()[leaves_small].period_m;
  needle_period_m = palette.materials()[leaves_needle].period_m;
}

Mesh build_tree(TreeKind kind, const PlantMaterials& materials, Random random) {
  const Foliage broad{materials.leaves_broad, materials.broad_period_m, 1.45f, 0.0f};
  const Foliage small{materials.leaves_small, materials.small_period_m, 1.25f, 0.35f};
  const Tint bark = grey(between(random, 0.75, 1.0));
  switch (kind) {
    case TreeKind::kBroad:
      return build_broad({9.0f, 2.4f, 3.1f, 6.4f, 9, 240, 0.2f}, broad, materials.bark, bark, random);
    case TreeKind::kSpreading:
      return build_broad({10.0f, 2.8f, 4.4f, 6.6f, 12, 310, 0.3f},
                         {materials.leaves_broad, materials.broad_period_m, 1.6f, 0.0f}, materials.bark, bark, random);
    case TreeKind::kBirch:
      return build_broad({10.5f, 2.8f, 2.3f, 7.8f, 10, 210, 0.14f}, small, materials.bark, tint_of(1.0f, 1.0f, 1.0f),
                         random);
    case TreeKind::kPoplar:
      return build_broad({13.0f, 1.6f, 1.7f, 11.4f, 11, 240, 0.19f}, small, materials.bark, bark, random);
    case TreeKind::kYoung:
      return build_broad({5.2f, 2.0f, 1.5f, 3.3f, 5, 95, 0.07f},
                         {materials.leaves_broad, materials.broad_period_m, 1.05f, 0.0f}, materials.bark, bark, random);
    case TreeKind::kSpruce:
      return build_conifer(between(random, 10.5, 12.5), 2.6f, 0.7f, 20, materials, random);
    case TreeKind::kPine: {
      Mesh mesh = build_broad({11.5f, 5.2f, 2.6f, 6.0f, 8, 170, 0.2f},
                              {materials.leaves_needle, materials.needle_period_m, 1.35f, 0.1f}, materials.bark,
                              tint_of(1.0f, 0.8f, 0.62f), random);
      return mesh;
    }
  }
  return {};
}

Mesh build_shrub(const PlantMaterials& materials, float height_m, bool is_flowering, Random random) {
  Mesh mesh;
  const float radius = 0.62f * height_m;
  const Vector3f crown(0, 0, 0.5f * height_m);
  std::vector<Cluster> clusters{{crown, {0.8f * radius, 0.8f * radius, 0.45f * height_m}}};
  for (int i = 0; i < 4; ++i) {
    const float angle = 1.57f * static_cast<float>(i) + between(random, -0.5, 0.5);
    clusters.push_back({crown + Vector3f(0.45f * radius * std::cos(angle), 0.45f * radius * std::sin(angle),
                                         between(random, -0.2, 0.12) * height_m),
                        Vector3f::Constant(0.48f * radius)});
    add_branch(mesh, {0, 0, -0.05f}, clusters.back().centre, 0.03f, materials.bark, grey(0.7f));
  }
  const Foliage foliage{random.chance(0.5) ? materials.leaves_small : materials.leaves_broad, materials.small_period_m,
                        0.55f + 0.22f * height_m, 0.0f};
  add_crown(mesh, clusters, crown - Vector3f(0, 0, 0.3f * height_m), radius, 65, foliage, random);
  if (is_flowering) {
    for (int i = 0; i < 40; ++i) {
      Vector3f out = direction(random);
      out.z() = std::abs(out.z());
      const Vector3f place = crown + out.cwiseProduct(Vector3f(radius, radius, 0.52f * height_m));
      add_ellipsoid(mesh, place, Vector3f::Constant(0.05f), 5, 3, materials.flowers, grey(1.0f));
    }
  }
  return mesh;
}

Mesh build_hedge(const PlantMaterials& materials, float height_m, float width_m, Random random) {
  Mesh mesh;
  constexpr int kStations = 9, kAround = 11;
  std::vector<Vector3f> grid;
  // an arched cross section, bumpy except at the ends
  for (int station = 0; station < kStations; ++station) {
    const float x = -1.0f + 2.0f * static_cast<float>(station) / (kStations - 1);
    const bool is_end = station == 0 || station == kStations - 1;
    for (int i = 0; i < kAround; ++i) {
      const float share = static_cast<float>(i) / (kAround - 1);  // left foot, top, right foot
      float y = 0.0f, z = 0.0f;
      if (share < 0.35f) {
        y = 1.0f;
        z = share / 0.35f * 0.92f;
      } else if (share > 0.65f) {
        y = -1.0f;
        z = (1.0f - share) / 0.35f * 0.92f;
      } else {
        y = 1.0f - 2.0f * (share - 0.35f) / 0.3f;
        z = 1.0f - 0.08f * std::pow(std::abs(y), 4.0f);
      }
      const float bump = is_end ? 0.0f : between(random, -0.07, 0.07);
      grid.emplace_back(x, (0.5f * width_m + bump) * y, (z + (z > 0.8f ? bump : 0.0f)) * height_m - 0.05f);
    }
  }
  add_surface(mesh, grid, kAround, [&](int, int) { return materials.hedge; });
  for (auto& vertex : mesh.vertices)
    vertex.tint = grey(0.6f + 0.4f * std::clamp(vertex.position.z() / height_m, 0.0f, 1.0f));
  const int cards = static_cast<int>(46.0f * height_m);
  for (int i = 0; i < cards; ++i) {
    const float x = between(random, -0.95, 0.95);
    const float around = between(random, -1.0, 1.0) * (height_m + 0.5f * width_m);
    const float side = around > 0.0f ? 1.0f : -1.0f;
    const float up = std::min(std::abs(around), height_m);
    const float over = std::max(0.0f, std::abs(around) - height_m);
    const Vector3f place(x, side * (0.5f * width_m - over + 0.03f), up);
    const Vector3f normal = Vector3f(0, over > 0.02f ? 0.3f * side : side, over > 0.02f ? 1.0f : 0.35f).normalized();
    const Vector3f facing = (normal + 0.7f * direction(random)).normalized();
    const Vector3f right = facing.cross(Vector3f(0.3f, 0.1f, 0.95f)).normalized();
    const float half = between(random, 0.14, 0.25);
    add_card(mesh, place, half * right, half * facing.cross(right), normal, materials.small_period_m,
             materials.leaves_small, grey((0.55f + 0.4f * up / height_m) * between(random, 0.8, 1.0)));
  }
  return mesh;
}

Mesh build_flower_bed(const PlantMaterials& materials, Random random) {
  Mesh mesh;
  add_block(mesh, {-1.0f, -0.5f, -0.1f}, {1.0f, 0.5f, 0.06f}, materials.soil, grey(0.9f));
  for (int i = 0; i < 26; ++i) {
    const Vector3f place(between(random, -0.9, 0.9), between(random, -0.42, 0.42), between(random, 0.1, 0.2));
    add_ellipsoid(mesh, place, {between(random, 0.08, 0.16), between(random, 0.08, 0.16), between(random, 0.08, 0.15)},
                  6, 4, random.chance(0.7) ? materials.flowers : materials.hedge, grey(between(random, 0.7, 1.0)));
  }
  return mesh;
}

}  // namespace panvo::simulated_world
