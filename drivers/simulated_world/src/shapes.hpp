// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "panvo/simulated_world/mesh.hpp"
#include "panvo/simulated_world/palette.hpp"
#include "panvo/simulated_world/random.hpp"

namespace panvo::simulated_world {

inline constexpr float kPi = std::numbers::pi_v<float>;

/// A random number in [low, high).
inline float between(Random& random, double low, double high) { return static_cast<float>(random.uniform(low, high)); }

/// A tint with these factors (0..1) for the albedo and the texture's contrast.
inline Tint tint_of(float red, float green, float blue, float contrast = 1.0f) {
  const auto byte = [](float share) {
    return static_cast<std::uint8_t>(std::clamp(share, 0.0f, 1.0f) * 255.0f + 0.5f);
  };
  return {byte(red), byte(green), byte(blue), byte(contrast)};
}

inline Tint grey(float brightness) { return tint_of(brightness, brightness, brightness); }

/// The tint scaled by `brightness`.
inline Tint shaded(const Tint& tint, float brightness) {
  const float scale = brightness / 255.0f;
  Tint result = tint_of(scale * tint.red, scale * tint.green, scale * tint.blue);
  result.contrast = tint.contrast;
  return result;
}

/// Adds a straight, possibly tapered tube of `sides` sides, smooth-shaded; v runs along it. Ends are open unless
/// `closed`.
void add_tube(Mesh& mesh, const Eigen::Vector3f& from, const Eigen::Vector3f& to, float from_radius, float to_radius,
              int sides, std::uint16_t material, Tint tint = {}, bool closed = false);

/// Adds a tube through points, with a radius at each.
void add_bent_tube(Mesh& mesh, std::span<const Eigen::Vector3f> points, std::span<const float> radii, int sides,
                   std::uint16_t material, Tint tint = {});

/// Adds an ellipsoid with half axes `radii` along x, y, z, smooth-shaded.
void add_ellipsoid(Mesh& mesh, const Eigen::Vector3f& centre, const Eigen::Vector3f& radii, int around, int rings,
                   std::uint16_t material, Tint tint = {});

/// Adds a leaf card: a quad centred at `centre` that shows one period of its material, shaded with `normal`.
void add_card(Mesh& mesh, const Eigen::Vector3f& centre, const Eigen::Vector3f& half_right,
              const Eigen::Vector3f& half_up, const Eigen::Vector3f& normal, float period_m, std::uint16_t material,
              Tint tint);

/// Adds an axis-aligned box between two corners; see add_box for rotated boxes.
void add_block(Mesh& mesh, const Eigen::Vector3f& low, const Eigen::Vector3f& high, std::uint16_t material,
               Tint tint = {});

/// Adds a surface through a grid of points, row by row with `columns` per row, with smooth normals (outwards: column
/// direction x row direction). `material` gives the material of each cell by column and row.
template <typename MaterialOfCell>
void add_surface(Mesh& mesh, const std::vector<Eigen::Vector3f>& points, int columns, MaterialOfCell&& material,
                 Tint tint = {}) {
  const int rows = static_cast<int>(points.size()) / columns;
  const auto at = [&](int column, int row) { return points[static_cast<std::size_t>(row * columns + column)]; };
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  std::vector<float> along_row(static_cast<std::size_t>(columns), 0.0f);
  for (int row = 0; row < rows; ++row) {
    float along = 0.0f;
    for (int column = 0; column < columns; ++column) {
      if (column > 0) along += (at(column, row) - at(column - 1, row)).norm();
      if (row > 0) along_row[static_cast<std::size_t>(column)] += (at(column, row) - at(column, row - 1)).norm();
      const Eigen::Vector3f across = at(std::min(column + 1, columns - 1), row) - at(std::max(column - 1, 0), row);
      const Eigen::Vector3f up = at(column, std::min(row + 1, rows - 1)) - at(column, std::max(row - 1, 0));
      Eigen::Vector3f normal = across.cross(up);
      normal = normal.norm() > 1e-9f ? normal.normalized() : Eigen::Vector3f::UnitZ();
      mesh.vertices.push_back({at(column, row), normal, {along, along_row[static_cast<std::size_t>(column)]}, tint});
    }
  }
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column + 1 < columns; ++column) {
      const auto a = first + static_cast<std::uint32_t>(row * columns + column);
      const auto width = static_cast<std::uint32_t>(columns);
      const std::uint16_t number = material(column, row);
      mesh.triangles.push_back({{a, a + 1, a + width + 1}, number});
      mesh.triangles.push_back({{a, a + width + 1, a + width}, number});
    }
  }
}

}  // namespace panvo::simulated_world
