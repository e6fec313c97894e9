// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/mesh.hpp"

#include <cmath>
#include <numbers>

namespace panvo::simulated_world {

void Mesh::add_polygon(const std::vector<Vertex>& corners, std::uint16_t material) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), corners.begin(), corners.end());
  for (std::uint32_t i = 2; i < corners.size(); ++i) {
    triangles.push_back({{first, first + i - 1, first + i}, material});
  }
}

void Mesh::add_quad(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c,
                    const Eigen::Vector3f& d, std::uint16_t material, const Eigen::Vector2f& uv_origin, Tint tint) {
  const Eigen::Vector3f normal = (b - a).cross(d - a).normalized();
  const float width = (b - a).norm();
  const float height = (d - a).norm();
  const auto corner = [&](const Eigen::Vector3f& position, float u, float v) {
    return Vertex{position, normal, uv_origin + Eigen::Vector2f(u, v), tint};
  };
  add_polygon({corner(a, 0, 0), corner(b, width, 0), corner(c, width, height), corner(d, 0, height)}, material);
}

void Mesh::add_box(const Eigen::Isometry3f& world_from_box, const Eigen::Vector3f& size, std::uint16_t material,
                   Tint tint) {
  const Eigen::Vector3f half = 0.5f * size;
  const auto corner = [&](int x, int y, int z) {
    return Eigen::Vector3f(world_from_box * half.cwiseProduct(Eigen::Vector3f(
                                                static_cast<float>(x), static_cast<float>(y), static_cast<float>(z))));
  };
  const auto side = [&](const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c,
                        const Eigen::Vector3f& d) { add_quad(a, b, c, d, material, Eigen::Vector2f::Zero(), tint); };
  side(corner(1, -1, -1), corner(1, 1, -1), corner(1, 1, 1), corner(1, -1, 1));
  side(corner(-1, 1, -1), corner(-1, -1, -1), corner(-1, -1, 1), corner(-1, 1, 1));
  side(corner(1, 1, -1), corner(-1, 1, -1), corner(-1, 1, 1), corner(1, 1, 1));
  side(corner(-1, -1, -1), corner(1, -1, -1), corner(1, -1, 1), corner(-1, -1, 1));
  side(corner(-1, -1, 1), corner(1, -1, 1), corner(1, 1, 1), corner(-1, 1, 1));
  side(corner(-1, 1, -1), corner(1, 1, -1), corner(1, -1, -1), corner(-1, -1, -1));
}

void Mesh::add_column(const Eigen::Vector3f& foot, float foot_radius, float top_radius, float height, int sides,
                      std::uint16_t material, Tint tint) {
  const auto rim = [&](int i, float radius, float z) {
    const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(sides);
    const Eigen::Vector3f outwards(std::cos(angle), std::sin(angle), 0.0f);
    const float around = foot_radius * angle;
    return Vertex{foot + radius * outwards + Eigen::Vector3f(0, 0, z), outwards, {around, z}, tint};
  };
  std::vector<Vertex> top;
  for (int i = 0; i < sides; ++i) {
    add_polygon({rim(i, foot_radius, 0), rim(i + 1, foot_radius, 0), rim(i + 1, top_radius, height),
                 rim(i, top_radius, height)},
                material);
    top.push_back(rim(i, top_radius, height));
    top.back().normal = Eigen::Vector3f::UnitZ();
    top.back().uv = top.back().position.head<2>() - foot.head<2>();
  }
  add_polygon(top, material);
}

void Mesh::append(const Mesh& other, const Eigen::Affine3f& world_from_other) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  const Eigen::Matrix3f rotation = world_from_other.rotation();
  for (auto vertex : other.vertices) {
    vertex.position = world_from_other * vertex.position;
    vertex.normal = rotation * vertex.normal;
    vertices.push_back(vertex);
  }
  for (auto triangle : other.triangles) {
    for (auto& corner : triangle.corners) corner += first;
    triangles.push_back(triangle);
  }
}

}  // namespace panvo::simulated_world
