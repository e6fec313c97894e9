// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "panvo/simulated_world/mesh.hpp"
#include "panvo/simulated_world/palette.hpp"
#include "panvo/simulated_world/random.hpp"

namespace panvo::simulated_world {

/// The palette indices of building materials.
struct BuildingMaterials {
  explicit BuildingMaterials(const Palette& palette);

  std::uint16_t glass, window_frame, door_wood, shutter, ledge, roof_tiles, roof_slate, roof_gravel, gutter,
      curtain_light, curtain_dark, concrete, slabs, metal_painted, metal_post, metal_sheet, concrete_panels, lamp_head,
      sign_white, sign_blue, poster, leaves, wood_planks, stone_blocks, stone_rubble, plaster_white, brick_red,
      wood_fence;
  float leaves_period_m;
};

enum class WindowKind { kCasement, kCross, kSash, kLattice, kPlain, kBand };
enum class HeadKind { kFlat, kSegment, kArch };
enum class RoofKind { kFlat, kGable, kHip };
enum class BuildingUse { kHouse, kTown, kInstitute, kHall };

/// The style of a building, shared by all its facades and by its twins. Lengths in m.
struct FacadeStyle {
  BuildingUse use = BuildingUse::kTown;
  int floors = 3;
  float ground_floor_height = 3.6f, floor_height = 3.1f;
  float bay = 3.0f;
  float window_width = 1.2f, window_height = 1.6f, sill_height = 0.9f;
  float recess = 0.18f;
  WindowKind window = WindowKind::kCross;
  HeadKind head = HeadKind::kFlat, ground_head = HeadKind::kFlat;
  RoofKind roof = RoofKind::kGable;
  float roof_slope = 0.8f, eaves = 0.4f;
  bool dormers = false, chimneys = true;
  float base_height = 0.5f;
  bool ledges = false, sills = true, lintels = false, surrounds = false, keystones = false, pediments = false,
       quoins = false, shutters = false, balconies = false, dentils = false, pilasters = false, shopfronts = false,
       gutters = true, ivy = false, two_tone = false;
  float cornice = 0.25f;    ///< protrusion
  float blank_bays = 0.2f;  ///< fraction of a side's bays without windows
  float grime = 0.25f;      ///< darkening of the wall at its base, as a fraction
  float contrast = 1.0f;    ///< of its textures
  std::uint16_t wall = 0, ground_wall = 0, base = 0, trim = 0, roof_cover = 0;
  Tint wall_tint, trim_tint, frame_tint, shutter_tint, door_tint, roof_tint;
};

/// Draws a random style.
FacadeStyle draw_style(BuildingUse use, const Palette& palette, const BuildingMaterials& materials, Random random);

/// The frame of a wall: u to the right as seen from outside, `out` outwards, z up from the ground floor.
struct WallFrame {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();  ///< the wall's left end, at z = 0
  Eigen::Vector3f right = Eigen::Vector3f::UnitX(), outwards = -Eigen::Vector3f::UnitY();  ///< unit, horizontal
  float width = 0.0f;
  float depth_below = 0.5f;  ///< depth of the wall below z = 0

  Eigen::Vector3f at(float u, float out, float z) const {
    return origin + u * right + out * outwards + Eigen::Vector3f(0, 0, z);
  }
};

enum class FacadeSide { kFront, kSide, kBack };

/// Adds a wall with all its details, up to the eaves. `lights`: random numbers for unique details: curtains, signs,
/// stains.
void build_facade(const FacadeStyle& style, const BuildingMaterials& materials, const WallFrame& frame, FacadeSide side,
                  Random lights, Mesh& mesh);

/// Height (m) of the walls above the ground floor.
float wall_height(const FacadeStyle& style);

/// Adds a box on a wall: u0 to u1, z0 to z1, and `behind` to `front` outwards; without its hidden back.
void add_wall_box(Mesh& mesh, const WallFrame& frame, float u0, float u1, float z0, float z1, float behind, float front,
                  std::uint16_t material, Tint tint);

/// An opening in a wall; `rise`: height of its arch.
struct Opening {
  float left = 0.0f, right = 0.0f, bottom = 0.0f, top = 0.0f, rise = 0.0f;

  float middle() const { return 0.5f * (left + right); }
};

/// Fills an opening (facade_windows.cpp).
void build_window(const FacadeStyle& style, const BuildingMaterials& materials, const WallFrame& frame,
                  const Opening& opening, bool is_simple, Random& lights, Mesh& mesh);
void build_door(const FacadeStyle& style, const BuildingMaterials& materials, const WallFrame& frame,
                const Opening& opening, Random& lights, Mesh& mesh);

/// Wall fixtures (facade_fixtures.cpp): at a door, steps, a canopy or lamp and a plate; at a shop, a sign, sometimes an
/// awning or a poster; a balcony with its door, the lowest one deeper; a band over an arch; an air conditioner; ivy.
void build_entrance(const FacadeStyle& style, const BuildingMaterials& materials, const WallFrame& frame,
                    const Opening& opening, Random& lights, Mesh& mesh);
void build_shop_sign(const FacadeStyle& style, const BuildingMaterials& materials, const WallFrame& frame,
                     const Opening& opening, Random& lights, Mesh& mesh);
void build_balcony(const FacadeStyle& style, const BuildingMaterials& materials, const WallFrame& frame,
                   const Opening& opening, bool is_lowest, Mesh& mesh);
void build_arch_band(const FacadeStyle& style, const WallFrame& frame, const Opening& opening, Mesh& mesh);
void build_air_conditioner(const BuildingMaterials& materials, const WallFrame& frame, const Opening& opening,
                           Mesh& mesh);
void build_ivy(const FacadeStyle& style, const BuildingMaterials& materials, const WallFrame& frame, Random& lights,
               Mesh& mesh);

/// Height (m) of a door's threshold above the ground: a whole number of steps.
float entry_height(const FacadeStyle& style);

/// The outline of an opening, from its lower left corner clockwise (as seen from outside) to its lower right one.
std::vector<Eigen::Vector2f> outline(const Opening& opening);

}  // namespace panvo::simulated_world
