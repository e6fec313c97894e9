// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "../shapes.hpp"
#include "facade.hpp"

namespace panvo::simulated_world {
namespace {

constexpr int kArchSegments = 8;

/// The outline shrunk by `inset` on all sides.
std::vector<Eigen::Vector2f> drawn_in(const std::vector<Eigen::Vector2f>& outline, float inset) {
  Eigen::Vector2f low = outline.front(), high = outline.front();
  for (const auto& point : outline) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Eigen::Vector2f centre = 0.5f * (low + high);
  const Eigen::Vector2f half = 0.5f * (high - low);
  const Eigen::Vector2f scale = (half.array() - inset).max(0.01f) / half.array();
  std::vector<Eigen::Vector2f> result;
  for (const auto& point : outline) result.push_back(centre + scale.cwiseProduct(point - centre));
  return result;
}

void add_pane(Mesh& mesh, const WallFrame& frame, const std::vector<Eigen::Vector2f>& outline, float out,
              std::uint16_t material, Tint tint) {
  std::vector<Vertex> corners;
  for (auto point = outline.rbegin(); point != outline.rend(); ++point) {
    corners.push_back({frame.at(point->x(), out, point->y()), frame.outwards, *point, tint});
  }
  mesh.add_polygon(corners, material);
}

void add_flat(Mesh& mesh, const WallFrame& frame, float u0, float u1, float z0, float z1, float out,
              std::uint16_t material, Tint tint) {
  mesh.add_quad(frame.at(u0, out, z0), frame.at(u1, out, z0), frame.at(u1, out, z1), frame.at(u0, out, z1), material,
                {u0, z0}, tint);
}

/// The frame around an opening: its face and the edge towards the glass.
void add_outer_frame(Mesh& mesh, const WallFrame& frame, const std::vector<Eigen::Vector2f>& outer,
                     const std::vector<Eigen::Vector2f>& inner, float glass_out, float face_out, bool has_edges,
                     std::uint16_t material, Tint tint) {
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const std::size_t next = (i + 1) % outer.size();
    const auto at = [&](const Eigen::Vector2f& point, float out) { return frame.at(point.x(), out, point.y()); };
    mesh.add_quad(at(outer[next], face_out), at(outer[i], face_out), at(inner[i], face_out), at(inner[next], face_out),
                  material, Eigen::Vector2f::Zero(), tint);
    if (!has_edges) continue;
    mesh.add_quad(at(inner[next], face_out), at(inner[i], face_out), at(inner[i], glass_out),
                  at(inner[next], glass_out), material, Eigen::Vector2f::Zero(), shaded(tint, 0.9f));
  }
}

/// Curtains and blinds behind the glass, drawn on its surface, because the glass is what reflects.
void add_curtains(const BuildingMaterials& materials, const WallFrame& frame, const Opening& pane, float out,
                  Random& lights, Mesh& mesh) {
  const float width = pane.right - pane.left, height = pane.top - pane.bottom;
  const double kind = lights.uniform();
  const float bright = static_cast<float>(lights.uniform(0.45, 0.85));
  const Tint cloth = tint_of(bright, bright * static_cast<float>(lights.uniform(0.93, 1.0)),
                             bright * static_cast<float>(lights.uniform(0.82, 1.0)));
  if (kind < 0.25) {  // drawn to both sides
    const float share = static_cast<float>(lights.uniform(0.12, 0.3));
    add_flat(mesh, frame, pane.left, pane.left + share * width, pane.bottom, pane.top, out, materials.curtain_light,
             cloth);
    add_flat(mesh, frame, pane.right - share * width, pane.right, pane.bottom, pane.top, out, materials.curtain_light,
             cloth);
  } else if (kind < 0.42) {  // a partly lowered blind
    const float share = static_cast<float>(lights.uniform(0.2, 0.75));
    add_flat(mesh, frame, pane.left, pane.right, pane.top - share * height, pane.top, out, materials.curtain_light,
             cloth);
  } else if (kind < 0.52) {  // half-height net curtain
    add_flat(mesh, frame, pane.left, pane.right, pane.bottom, pane.bottom + 0.5f * height, out, materials.curtain_light,
             cloth);
  } else if (kind < 0.6) {
    add_flat(mesh, frame, pane.left, pane.right, pane.bottom, pane.top, out, materials.curtain_dark, cloth);
  }
}

struct Bars {
  int columns = 1, rows = 1;  ///< panes
  float transom = 0.0f;       ///< height of a single crossbar, as a fraction; 0: equal rows
};

Bars bars_of(WindowKind kind) {
  switch (kind) {
    case WindowKind::kCasement:
      return {2, 1, 0.0f};
    case WindowKind::kCross:
      return {2, 2, 0.7f};
    case WindowKind::kSash:
      return {1, 2, 0.5f};
    case WindowKind::kLattice:
      return {3, 4, 0.0f};
    case WindowKind::kPlain:
      return {1, 1, 0.0f};
    case WindowKind::kBand:
      return {2, 1, 0.0f};
  }
  return {};
}

}  // namespace

std::vector<Eigen::Vector2f> outline(const Opening& opening) {
  std::vector<Eigen::Vector2f> points{{opening.left, opening.bottom}};
  if (opening.rise <= 0.0f) {
    points.emplace_back(opening.left, opening.top);
    points.emplace_back(opening.right, opening.top);
  } else {
    const float half = 0.5f * (opening.right - opening.left);
    // circle through both ends of the springing line and the crown
    const float radius = (half * half + opening.rise * opening.rise) / (2.0f * opening.rise);
    const float reach = std::asin(std::min(1.0f, half / radius));
    for (int i = 0; i <= kArchSegments; ++i) {
      const float angle = reach * (2.0f * static_cast<float>(i) / kArchSegments - 1.0f);
      points.emplace_back(opening.middle() + radius * std::sin(angle),
                          opening.top + opening.rise - radius * (1.0f - std::cos(angle)));
    }
  }
  points.emplace_back(opening.right, opening.bottom);
  return points;
}

void build_window(const FacadeStyle& style, const BuildingMaterials& materials, const WallFrame& frame,
                  const Opening& opening, bool is_simple, Random& lights, Mesh& mesh) {
  const float glass_out = -style.recess;
  const float face_out = glass_out + 0.045f;
  const float bar = style.window == WindowKind::kBand ? 0.045f : 0.065f;
  const auto outer = outline(opening);
  const auto inner = drawn_in(outer, bar);
  const float brightness = static_cast<float>(lights.uniform(0.75, 1.0));
  add_pane(mesh, frame, inner, glass_out, materials.glass,
           tint_of(brightness, brightness, brightness * static_cast<float>(lights.uniform(0.92, 1.0))));
  add_outer_frame(mesh, frame, outer, inner, glass_out, face_out, !is_simple, materials.window_frame, style.frame_tint);
  const Opening pane{opening.left + bar, opening.right - bar, opening.bottom + bar,
                     opening.top - (opening.rise > 0.0f ? 0.0f : bar), 0.0f};
  add_curtains(materials, frame, pane, glass_out + 0.008f, lights, mesh);
  const Bars bars = bars_of(style.window);
  const float width = pane.right - pane.left, height = pane.top - pane.bottom;
  const float thin = bars.columns > 2 ? 0.016f : 0.032f;
  const auto add_bar = [&](float u0, float u1, float z0, float z1) {
    if (is_simple) {
      add_flat(mesh, frame, u0, u1, z0, z1, face_out - 0.01f, materials.window_frame, style.frame_tint);
    } else {
      // its face and its two long sides
      const bool is_upright = z1 - z0 > u1 - u0;
      const float out = face_out - 0.005f;
      add_flat(mesh, frame, u0, u1, z0, z1, out, materials.window_frame, style.frame_tint);
      const auto side = [&](float au, float az, float bu, float bz) {
        mesh.add_quad(frame.at(au, glass_out, az), frame.at(bu, glass_out, bz), frame.at(bu, out, bz),
                      frame.at(au, out, az), materials.window_frame, Eigen::Vector2f::Zero(),
                      shaded(style.frame_tint, 0.9f));
      };
      if (is_upright) {
        side(u0, z1, u0, z0);
        side(u1, z0, u1, z1);
      } else {
        side(u0, z0, u1, z0);
        side(u1, z1, u0, z1);
      }
    }
  };
  for (int i = 1; i < bars.columns; ++i) {
    const float u = pane.left + width * static_cast<float>(i) / static_cast<float>(bars.columns);
    const bool is_central = 2 * i == bars.columns;
    add_bar(u - thin, u + thin, pane.bottom, pane.top + (is_central ? 0.92f * opening.rise : 0.3f * opening.rise));
  }
  for (int i = 1; i < bars.rows; ++i) {
    const float share = bars.transom > 0.0f ? bars.transom : static_cast<float>(i) / static_cast<float>(bars.rows);
    const float z = pane.bottom + share * height;
    add_bar(pane.left, pane.right, z - thin, z + thin);
  }
  if (opening.rise > 0.3f) add_bar(pane.left, pane.right, pane.top - 0.03f, pane.top + 0.03f);
}

void build_door(const FacadeStyle& style, const BuildingMaterials& materials, const WallFrame& frame,
                const Opening& opening, Random& lights, Mesh& mesh) {
  const float leaf_out = -style.recess - 0.08f;
  const float face_out = leaf_out + 0.06f;
  const auto outer = outline(opening);
  const auto inner = drawn_in(outer, 0.08f);
  add_outer_frame(mesh, frame, outer, inner, leaf_out, face_out, true, materials.window_frame, style.frame_tint);
  const float width = opening.right - opening.left;
  const float left = opening.left + 0.08f, right = opening.right - 0.08f;
  const float light_from = opening.rise > 0.0f ? opening.top : opening.top - 0.45f;  // the fanlight
  add_pane(mesh, frame, inner, leaf_out - 0.01f, materials.glass, grey(0.8f));
  const int leaves = width > 1.5f ? 2 : 1;
  const bool is_glazed = style.use == BuildingUse::kInstitute || lights.chance(0.3);
  for (int leaf = 0; leaf < leaves; ++leaf) {
    const float u0 = left + (right - left) * static_cast<float>(leaf) / static_cast<float>(leaves);
    const float u1 = left + (right - left) * static_cast<float>(leaf + 1) / static_cast<float>(leaves);
    const std::uint16_t wood = is_glazed ? materials.window_frame : materials.door_wood;
    const Tint tint = is_glazed ? style.frame_tint : style.door_tint;
    if (is_glazed) {
      add_wall_box(mesh, frame, u0, u0 + 0.1f, opening.bottom, light_from, leaf_out, leaf_out + 0.04f, wood, tint);
      add_wall_box(mesh, frame, u1 - 0.1f, u1, opening.bottom, light_from, leaf_out, leaf_out + 0.04f, wood, tint);
      add_wall_box(mesh, frame, u0, u1, opening.bottom, opening.bottom + 0.3f, leaf_out, leaf_out + 0.035f, wood, tint);
    } else {
      add_flat(mesh, frame, u0 + 0.01f, u1 - 0.01f, opening.bottom, light_from, leaf_out + 0.02f, wood, tint);
      const float middle = opening.bottom + 0.45f * (light_from - opening.bottom);
      for (const auto& [z0, z1] :
           {std::pair{opening.bottom + 0.15f, middle - 0.08f}, {middle + 0.08f, light_from - 0.15f}}) {
        add_wall_box(mesh, frame, u0 + 0.14f, u1 - 0.14f, z0, z1, leaf_out + 0.02f, leaf_out + 0.04f, wood,
                     shaded(tint, 0.85f));
      }
    }
    add_wall_box(mesh, frame, u1 - 0.1f, u1 - 0.05f, opening.bottom + 0.95f, opening.bottom + 1.1f, leaf_out,
                 leaf_out + 0.1f, materials.metal_post, grey(0.8f));
  }
  add_wall_box(mesh, frame, left, right, light_from, light_from + 0.08f, leaf_out - 0.01f, face_out,
               materials.window_frame, style.frame_tint);
}

}  // namespace panvo::simulated_world
