// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace panvo::simulated_world {

/// Changes the appearance of a material at a vertex.
struct Tint {
  std::uint8_t red = 255, green = 255, blue = 255;  ///< multiply the albedo; 255: unchanged
  std::uint8_t contrast = 255;                      ///< of the texture about its mean; 0: plain, 255: unchanged
};

struct Vertex {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< m
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();   ///< unit, outwards
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();        ///< m along the surface; the material has the texture's period
  Tint tint;
};

struct Triangle {
  std::array<std::uint32_t, 3> corners{};  ///< into the mesh's vertices, counter-clockwise seen from outside
  std::uint16_t material = 0;              ///< into the palette
};

/// Triangles with their materials; z up, metres. Surfaces are visible from both sides.
struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;

  /// Adds a convex polygon as a fan; corners counter-clockwise seen from outside.
  void add_polygon(const std::vector<Vertex>& corners, std::uint16_t material);

  /// Adds a flat quad a, b, c, d (counter-clockwise seen from outside) with its own normal. uv runs from `uv_origin`
  /// along a->b (u) and a->d (v), in m.
  void add_quad(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c, const Eigen::Vector3f& d,
                std::uint16_t material, const Eigen::Vector2f& uv_origin = Eigen::Vector2f::Zero(), Tint tint = {});

  /// Adds a box with its centre at `centre_from_box` and edges of `size` along its axes.
  void add_box(const Eigen::Isometry3f& world_from_box, const Eigen::Vector3f& size, std::uint16_t material,
               Tint tint = {});

  /// Adds a vertical prism or cone frustum of `sides` sides with its base at `foot`, smooth-shaded; closed at the top.
  void add_column(const Eigen::Vector3f& foot, float foot_radius, float top_radius, float height, int sides,
                  std::uint16_t material, Tint tint = {});

  /// Adds another mesh, moved and (uniformly) scaled.
  void append(const Mesh& other, const Eigen::Affine3f& world_from_other);
};

}  // namespace panvo::simulated_world
