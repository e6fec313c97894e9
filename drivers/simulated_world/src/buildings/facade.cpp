// SPDX-License-Identifier: Apache-2.0
#include "facade.hpp"

#include <cmath>

#include "../shapes.hpp"

namespace panvo::simulated_world {
namespace {

enum class Cell { kBlank, kWindow, kDoor, kShop, kBalcony, kGate };

/// Builds one facade.
class FacadeBuilder {
 public:
  FacadeBuilder(const FacadeStyle& style, const BuildingMaterials& materials, const WallFrame& frame, FacadeSide side,
                Random lights, Mesh& mesh)
      : style_(style), materials_(materials), frame_(frame), side_(side), lights_(lights), mesh_(mesh) {
    bays_ = std::max(1, static_cast<int>(std::lround(frame.width / style.bay)));
    bay_ = frame.width / static_cast<float>(bays_);
    door_bay_ = style.use == BuildingUse::kTown || style.use == BuildingUse::kInstitute ? bays_ / 2 : bays_ / 3;
    uv_shift_ = static_cast<float>(lights_.uniform(0.0, 20.0));
    for (int bay = 0; bay < bays_; ++bay) {
      blank_.push_back(side != FacadeSide::kFront && bay != bays_ / 2 && lights_.chance(style.blank_bays));
    }
  }

  void build() {
    float floor_z = 0.0f;
    for (int floor = 0; floor < style_.floors; ++floor) {
      const float height = floor == 0 ? style_.ground_floor_height : style_.floor_height;
      for (int bay = 0; bay < bays_; ++bay) build_cell(floor, bay, floor_z, floor_z + height);
      floor_z += height;
      if (style_.ledges && floor + 1 < style_.floors) add_ledge(floor_z, floor == 0);
    }
    add_wall(0.0f, frame_.width, floor_z, wall_height(style_), style_.wall, bays_);
    add_base();
    add_top();
    add_ends();
    if (style_.ivy && side_ != FacadeSide::kBack) build_ivy(style_, materials_, frame_, lights_, mesh_);
  }

 private:
  bool is_simple() const { return side_ == FacadeSide::kBack; }
  /// Window frames are flat on sides that do not face the road.
  bool is_flat() const { return side_ != FacadeSide::kFront; }

  Cell cell_kind(int floor, int bay) const {
    if (blank_[static_cast<std::size_t>(bay)]) return Cell::kBlank;
    const bool is_front = side_ == FacadeSide::kFront;
    if (floor == 0 && style_.use == BuildingUse::kHall) {
      return is_front && bay % 3 == 1 ? Cell::kGate : Cell::kWindow;
    }
    if (is_front && floor == 0 && bay == door_bay_) return Cell::kDoor;
    if (is_front && floor == 0 && style_.shopfronts) return Cell::kShop;
    if (is_front && floor > 0 && style_.balconies && std::abs(2 * bay - bays_ + 1) <= 1 + bays_ % 2)
      return Cell::kBalcony;
    return Cell::kWindow;
  }

  Opening opening_of(Cell kind, int floor, int bay, float z0, float z1) const {
    const float middle = (static_cast<float>(bay) + 0.5f) * bay_;
    float half = 0.5f * std::min(style_.window_width, bay_ - 0.3f);
    float bottom = z0 + style_.sill_height;
    float top = bottom + style_.window_height;
    switch (kind) {
      case Cell::kDoor:
        half = style_.use == BuildingUse::kHouse ? 0.55f : 0.95f;
        half = std::min(half, 0.5f * bay_ - 0.2f);
        bottom = z0 + entry_height(style_);
        top = bottom + (style_.use == BuildingUse::kHouse ? 2.2f : 2.6f);
        break;
      case Cell::kShop:
        half = 0.5f * bay_ - 0.3f;
        bottom = z0 + 0.45f;
        top = z0 + style_.ground_floor_height - 1.0f;
        break;
      case Cell::kGate:
        half = std::min(1.9f, 0.5f * bay_ - 0.3f);
        bottom = z0 + 0.05f;
        top = z0 + 4.2f;
        break;
      case Cell::kBalcony:
        bottom = z0 + 0.1f;
        break;
      default:
        break;
    }
    Opening opening{middle - half, middle + half, bottom, std::min(top, z1 - 0.35f), 0.0f};
    const HeadKind head = floor == 0 ? style_.ground_head : style_.head;
    if (kind == Cell::kShop || kind == Cell::kGate || head == HeadKind::kFlat) return opening;
    opening.rise = std::min(head == HeadKind::kArch ? half : 0.3f * half, z1 - 0.3f - opening.top + 0.4f);
    opening.top = std::min(opening.top, z1 - 0.3f - opening.rise);
    return opening;
  }

  Tint wall_tint(float u, float z) const {
    // darker at the base, and uneven in patches of about a bay
    const auto cell = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::lround(2.0f * u)) * 7919 +
                                                 static_cast<std::int64_t>(std::lround(2.0f * z)));
    const float uneven = static_cast<float>(mix(cell) % 256) / 255.0f;
    const float foot = std::exp(-std::max(0.0f, z) / 0.7f);
    Tint tint = shaded(style_.wall_tint, (1.0f - style_.grime * foot) * (0.95f + 0.05f * uneven));
    tint.contrast = static_cast<std::uint8_t>(255.0f * style_.contrast);
    return tint;
  }

  Vertex wall_vertex(float u, float z) const {
    return {frame_.at(u, 0.0f, z), frame_.outwards, {u + uv_shift_, z}, wall_tint(u, z)};
  }

  void add_wall(float u0, float u1, float z0, float z1, std::uint16_t material, int parts = 1) {
    if (u1 - u0 < 1e-3f || z1 - z0 < 1e-3f) return;
    for (int part = 0; part < parts; ++part) {
      const float left = u0 + (u1 - u0) * static_cast<float>(part) / static_cast<float>(parts);
      const float right = u0 + (u1 - u0) * static_cast<float>(part + 1) / static_cast<float>(parts);
      mesh_.add_polygon({wall_vertex(left, z0), wall_vertex(right, z0), wall_vertex(right, z1), wall_vertex(left, z1)},
                        material);
    }
  }

  void build_cell(int floor, int bay, float z0, float z1) {
    const float u0 = static_cast<float>(bay) * bay_, u1 = u0 + bay_;
    const std::uint16_t wall = floor == 0 ? style_.ground_wall : style_.wall;
    const Cell kind = cell_kind(floor, bay);
    if (kind == Cell::kBlank) {
      const float middle = 0.5f * (z0 + z1);
      add_wall(u0, u1, z0, middle, wall, 2);
      add_wall(u0, u1, middle, z1, wall, 2);
      return;
    }
    const Opening opening = opening_of(kind, floor, bay, z0, z1);
    pierce(u0, u1, z0, z1, opening, wall);
    add_reveal(opening, kind == Cell::kDoor ? style_.recess + 0.09f : style_.recess, wall);
    if (kind == Cell::kDoor) {
      build_door(style_, materials_, frame_, opening, lights_, mesh_);
      build_entrance(style_, materials_, frame_, opening, lights_, mesh_);
    } else if (kind == Cell::kGate) {
      add_wall_box(mesh_, frame_, opening.left, opening.right, opening.bottom, opening.top, -0.2f, -0.08f,
                   materials_.metal_sheet, style_.shutter_tint);
    } else {
      build_window(style_, materials_, frame_, opening, is_flat(), lights_, mesh_);
      if (kind == Cell::kShop) build_shop_sign(style_, materials_, frame_, opening, lights_, mesh_);
      if (kind == Cell::kBalcony) build_balcony(style_, materials_, frame_, opening, floor == 1, mesh_);
    }
    if (kind != Cell::kGate && kind != Cell::kShop) trim(opening, floor, kind);
  }

  void pierce(float u0, float u1, float z0, float z1, const Opening& opening, std::uint16_t wall) {
    for (const auto& [left, right] : {std::pair{u0, opening.left}, {opening.right, u1}}) {
      add_wall(left, right, z0, opening.bottom, wall);
      add_wall(left, right, opening.bottom, opening.top, wall);
      add_wall(left, right, opening.top, z1, wall);
    }
    add_wall(opening.left, opening.right, z0, opening.bottom, wall);
    const auto edge = outline(opening);
    for (std::size_t i = 1; i + 2 < edge.size(); ++i) {
      mesh_.add_polygon({wall_vertex(edge[i].x(), edge[i].y()), wall_vertex(edge[i + 1].x(), edge[i + 1].y()),
                         wall_vertex(edge[i + 1].x(), z1), wall_vertex(edge[i].x(), z1)},
                        wall);
    }
  }

  void add_reveal(const Opening& opening, float depth, std::uint16_t wall) {
    const auto edge = outline(opening);
    for (std::size_t i = 0; i < edge.size(); ++i) {
      const Eigen::Vector2f& from = edge[i];
      const Eigen::Vector2f& to = edge[(i + 1) % edge.size()];
      mesh_.add_quad(frame_.at(from.x(), 0, from.y()), frame_.at(from.x(), -depth, from.y()),
                     frame_.at(to.x(), -depth, to.y()), frame_.at(to.x(), 0, to.y()), wall, {uv_shift_, from.y()},
                     shaded(wall_tint(from.x(), from.y()), 0.92f));
    }
  }

  /// Sill, surround, lintel, pediment and shutters of an opening.
  void trim(const Opening& opening, int floor, Cell kind) {
    const float top = opening.top + opening.rise;
    const bool is_window = kind == Cell::kWindow;
    if (style_.sills && is_window) {
      add_wall_box(mesh_, frame_, opening.left - 0.08f, opening.right + 0.08f, opening.bottom - 0.09f, opening.bottom,
                   -style_.recess + 0.02f, 0.09f, style_.trim, style_.trim_tint);
    }
    if (is_simple()) return;
    const auto strip = [&](float u0, float u1, float z0, float z1, float out) {
      add_wall_box(mesh_, frame_, u0, u1, z0, z1, 0.0f, out, style_.trim, style_.trim_tint);
    };
    if (style_.surrounds && opening.rise <= 0.0f) {
      strip(opening.left - 0.16f, opening.left, opening.bottom, top, 0.045f);
      strip(opening.right, opening.right + 0.16f, opening.bottom, top, 0.045f);
      strip(opening.left - 0.22f, opening.right + 0.22f, top, top + 0.2f, 0.06f);
    } else if (style_.lintels && opening.rise <= 0.0f) {
      strip(opening.left - 0.15f, opening.right + 0.15f, top, top + 0.22f, 0.02f);
    } else if (opening.rise > 0.0f && (style_.surrounds || style_.lintels)) {
      build_arch_band(style_, frame_, opening, mesh_);
    }
    if (style_.keystones) {
      strip(opening.middle() - 0.11f, opening.middle() + 0.11f, top - 0.02f, top + 0.3f, 0.1f);
    }
    if (style_.pediments && floor == 1 && opening.rise <= 0.0f) add_pediment(opening, top + 0.2f);
    if (style_.shutters && is_window && opening.rise <= 0.0f && style_.window != WindowKind::kBand) {
      const float width = 0.5f * (opening.right - opening.left);
      const bool is_open = !lights_.chance(0.08);
      for (const float side : {-1.0f, 1.0f}) {
        const float hinge = side < 0 ? opening.left : opening.right;
        const float other = is_open ? hinge + side * width : hinge - side * width;
        add_wall_box(mesh_, frame_, std::min(hinge, other), std::max(hinge, other), opening.bottom, opening.top,
                     is_open ? 0.0f : -0.06f, is_open ? 0.05f : -0.02f, materials_.shutter, style_.shutter_tint);
      }
    }
    if (is_window && side_ == FacadeSide::kSide && lights_.chance(0.05)) {
      build_air_conditioner(materials_, frame_, opening, mesh_);
    }
  }

  void add_pediment(const Opening& opening, float z) {
    const float left = opening.left - 0.28f, right = opening.right + 0.28f;
    const float crown = z + 0.1f + 0.18f * (right - left);
    add_wall_box(mesh_, frame_, left, right, z, z + 0.08f, 0.0f, 0.14f, style_.trim, style_.trim_tint);
    const auto vertex = [&](float u, float out, float height) {
      return Vertex{frame_.at(u, out, height), frame_.outwards, {u, height}, style_.trim_tint};
    };
    const float middle = opening.middle();
    mesh_.add_polygon({vertex(left, 0.08f, z + 0.08f), vertex(right, 0.08f, z + 0.08f), vertex(middle, 0.08f, crown)},
                      style_.trim);
    for (const float side : {left, right}) {
      const float a = side < middle ? side : middle, b = side < middle ? middle : side;
      const float za = side < middle ? z + 0.08f : crown, zb = side < middle ? crown : z + 0.08f;
      mesh_.add_quad(frame_.at(a, 0.14f, za), frame_.at(b, 0.14f, zb), frame_.at(b, 0.0f, zb + 0.04f),
                     frame_.at(a, 0.0f, za + 0.04f), style_.trim, {a, za}, style_.trim_tint);
    }
  }

  void add_ledge(float z, bool is_first) {
    const float height = is_first ? 0.24f : 0.14f;
    add_wall_box(mesh_, frame_, 0.0f, frame_.width, z - 0.5f * height, z + 0.5f * height, 0.0f, is_first ? 0.1f : 0.06f,
                 style_.trim, style_.trim_tint, bays_);
  }

  static void add_wall_box(Mesh& mesh, const WallFrame& frame, float u0, float u1, float z0, float z1, float behind,
                           float front, std::uint16_t material, Tint tint, int parts = 1) {
    // long ones in parts, so that shading per vertex can vary
    for (int part = 0; part < parts; ++part) {
      const float left = u0 + (u1 - u0) * static_cast<float>(part) / static_cast<float>(parts);
      const float right = u0 + (u1 - u0) * static_cast<float>(part + 1) / static_cast<float>(parts);
      panvo::simulated_world::add_wall_box(mesh, frame, left, right, z0, z1, behind, front, material, tint);
    }
  }

  /// The plinth, with a gap at each door and gate.
  void add_base() {
    std::vector<std::pair<float, float>> gaps;
    for (int bay = 0; bay < bays_; ++bay) {
      const Cell kind = cell_kind(0, bay);
      if (kind != Cell::kDoor && kind != Cell::kGate) continue;
      const Opening opening = opening_of(kind, 0, bay, 0.0f, style_.ground_floor_height);
      gaps.emplace_back(opening.left, opening.right);
    }
    float from = 0.0f;
    gaps.emplace_back(frame_.width, frame_.width);
    const Tint tint = shaded(style_.trim_tint, 0.75f);
    for (const auto& [left, right] : gaps) {
      const int parts = std::max(1, static_cast<int>((left - from) / bay_));
      add_wall_box(mesh_, frame_, from, left, -frame_.depth_below, style_.base_height, 0.0f, 0.05f, style_.base, tint,
                   parts);
      if (right > left) {
        add_wall_box(mesh_, frame_, left, right, -frame_.depth_below, 0.05f, -0.4f, 0.02f, style_.base, tint, 1);
      }
      from = right;
    }
  }

  void add_top() {
    const float top = wall_height(style_);
    if (style_.cornice > 0.12f) {
      add_wall_box(mesh_, frame_, 0.0f, frame_.width, top - 0.55f, top - 0.4f, 0.0f, 0.4f * style_.cornice, style_.trim,
                   style_.trim_tint, bays_);
      add_wall_box(mesh_, frame_, -style_.cornice, frame_.width + style_.cornice, top - 0.16f, top, 0.0f,
                   style_.cornice, style_.trim, style_.trim_tint, bays_);
      if (style_.dentils && side_ != FacadeSide::kBack) {
        const int count = static_cast<int>(frame_.width / 0.7f);
        for (int i = 0; i < count; ++i) {
          const float u = (static_cast<float>(i) + 0.5f) * frame_.width / static_cast<float>(count);
          add_wall_box(mesh_, frame_, u - 0.11f, u + 0.11f, top - 0.4f, top - 0.16f, 0.0f, 0.7f * style_.cornice,
                       style_.trim, style_.trim_tint, 1);
        }
      }
    } else {
      add_wall_box(mesh_, frame_, 0.0f, frame_.width, top - 0.22f, top, 0.0f, 0.05f, style_.trim, style_.trim_tint,
                   bays_);
    }
    if (style_.pilasters && side_ != FacadeSide::kBack) {
      for (int bay = 0; bay <= bays_; ++bay) {
        const float u = std::clamp(static_cast<float>(bay) * bay_, 0.13f, frame_.width - 0.13f);
        add_wall_box(mesh_, frame_, u - 0.13f, u + 0.13f, -frame_.depth_below, top, 0.0f, 0.16f, style_.trim,
                     shaded(style_.trim_tint, 0.85f), 1);
      }
    }
  }

  /// Quoins and downpipes at the wall's ends.
  void add_ends() {
    const float top = wall_height(style_);
    if (style_.quoins && side_ != FacadeSide::kBack) {
      int index = 0;
      for (float z = style_.base_height; z + 0.3f < top - 0.5f; z += 0.36f, ++index) {
        const float width = index % 2 == 0 ? 0.5f : 0.3f;
        add_wall_box(mesh_, frame_, -0.03f, width, z, z + 0.32f, 0.0f, 0.035f, style_.trim, style_.trim_tint, 1);
        add_wall_box(mesh_, frame_, frame_.width - width, frame_.width + 0.03f, z, z + 0.32f, 0.0f, 0.035f, style_.trim,
                     style_.trim_tint, 1);
      }
    }
    if (style_.gutters && side_ != FacadeSide::kSide) {
      for (const float u : {0.35f, frame_.width - 0.35f}) {
        add_tube(mesh_, frame_.at(u, 0.13f, -0.2f), frame_.at(u, 0.13f, top), 0.05f, 0.05f, 6, materials_.gutter,
                 grey(0.8f));
      }
    }
  }

  const FacadeStyle& style_;
  const BuildingMaterials& materials_;
  const WallFrame& frame_;
  FacadeSide side_;
  Random lights_;
  Mesh& mesh_;
  int bays_ = 1, door_bay_ = 0;
  float bay_ = 3.0f, uv_shift_ = 0.0f;
  std::vector<bool> blank_;
};

}  // namespace

void build_facade(const FacadeStyle& style, const BuildingMaterials& materials, const WallFrame& frame, FacadeSide side,
                  Random lights, Mesh& mesh) {
  FacadeBuilder(style, materials, frame, side, lights, mesh).build();
}

}  // namespace panvo::simulated_world
