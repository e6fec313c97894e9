// SPDX-License-Identifier: Apache-2.0
#include "shapes.hpp"

namespace panvo::simulated_world {
namespace {

/// A direction not parallel to `axis`. It must be constant along a tube so that its rows are not twisted.
Eigen::Vector3f aside_of(const Eigen::Vector3f& axis) {
  return std::abs(axis.normalized().z()) < 0.7f ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
}

/// Two unit vectors perpendicular to `axis` (unit) and to each other; right x forward = axis.
std::pair<Eigen::Vector3f, Eigen::Vector3f> square_to(const Eigen::Vector3f& axis, const Eigen::Vector3f& aside) {
  const Eigen::Vector3f right = aside.cross(axis).normalized();
  return {right, axis.cross(right)};
}

float turn(int part, int parts) { return 2.0f * kPi * static_cast<float>(part) / static_cast<float>(parts); }

}  // namespace

void add_tube(Mesh& mesh, const Eigen::Vector3f& from, const Eigen::Vector3f& to, float from_radius, float to_radius,
              int sides, std::uint16_t material, Tint tint, bool closed) {
  const Eigen::Vector3f points[] = {from, to};
  const float radii[] = {from_radius, to_radius};
  add_bent_tube(mesh, points, radii, sides, material, tint);
  if (!closed) return;
  const Eigen::Vector3f axis = (to - from).normalized();
  const auto [right, forward] = square_to(axis, aside_of(axis));
  for (const bool at_end : {false, true}) {
    std::vector<Vertex> rim;
    for (int i = 0; i < sides; ++i) {
      const float angle = turn(at_end ? i : sides - i, sides);
      const Eigen::Vector2f flat =
          (at_end ? to_radius : from_radius) * Eigen::Vector2f(std::cos(angle), std::sin(angle));
      rim.push_back({(at_end ? to : from) + flat.x() * right + flat.y() * forward, at_end ? axis : -axis, flat, tint});
    }
    mesh.add_polygon(rim, material);
  }
}

void add_bent_tube(Mesh& mesh, std::span<const Eigen::Vector3f> points, std::span<const float> radii, int sides,
                   std::uint16_t material, Tint tint) {
  std::vector<Eigen::Vector3f> grid;
  const Eigen::Vector3f aside = aside_of(points.back() - points.front());
  // one row per point; the row direction is such that columns x rows points outwards
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f axis = (points[std::min(i + 1, points.size() - 1)] - points[i > 0 ? i - 1 : 0]).normalized();
    const auto [right, forward] = square_to(axis, aside);
    for (int side = 0; side <= sides; ++side) {
      const float angle = turn(side, sides);
      grid.push_back(points[i] + radii[i] * (std::cos(angle) * right + std::sin(angle) * forward));
    }
  }
  const std::size_t first = mesh.vertices.size();
  add_surface(
      mesh, grid, sides + 1, [&](int, int) { return material; }, tint);
  // the seam's two columns share one normal
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int side = 0; side <= sides; ++side) {
      Vertex& vertex = mesh.vertices[first + i * static_cast<std::size_t>(sides + 1) + static_cast<std::size_t>(side)];
      const Eigen::Vector3f outwards = vertex.position - points[i];
      if (outwards.norm() > 1e-6f) vertex.normal = outwards.normalized();
    }
  }
}

void add_ellipsoid(Mesh& mesh, const Eigen::Vector3f& centre, const Eigen::Vector3f& radii, int around, int rings,
                   std::uint16_t material, Tint tint) {
  std::vector<Eigen::Vector3f> grid;
  for (int ring = 0; ring <= rings; ++ring) {
    const float polar = kPi * (static_cast<float>(ring) / static_cast<float>(rings) - 0.5f);
    for (int i = 0; i <= around; ++i) {
      const float angle = turn(i, around);
      grid.push_back(centre + radii.cwiseProduct(Eigen::Vector3f(std::cos(polar) * std::cos(angle),
                                                                 std::cos(polar) * std::sin(angle), std::sin(polar))));
    }
  }
  const std::size_t first = mesh.vertices.size();
  add_surface(
      mesh, grid, around + 1, [&](int, int) { return material; }, tint);
  for (std::size_t i = first; i < mesh.vertices.size(); ++i) {
    const Eigen::Vector3f from_centre = mesh.vertices[i].position - centre;
    mesh.vertices[i].normal = from_centre.cwiseQuotient(radii.cwiseProduct(radii)).normalized();
  }
}

void add_card(Mesh& mesh, const Eigen::Vector3f& centre, const Eigen::Vector3f& half_right,
              const Eigen::Vector3f& half_up, const Eigen::Vector3f& normal, float period_m, std::uint16_t material,
              Tint tint) {
  mesh.add_polygon({{centre - half_right - half_up, normal, {0.0f, 0.0f}, tint},
                    {centre + half_right - half_up, normal, {period_m, 0.0f}, tint},
                    {centre + half_right + half_up, normal, {period_m, period_m}, tint},
                    {centre - half_right + half_up, normal, {0.0f, period_m}, tint}},
                   material);
}

void add_block(Mesh& mesh, const Eigen::Vector3f& low, const Eigen::Vector3f& high, std::uint16_t material, Tint tint) {
  Eigen::Isometry3f frame = Eigen::Isometry3f::Identity();
  frame.translation() = 0.5f * (low + high);
  mesh.add_box(frame, high - low, material, tint);
}

}  // namespace panvo::simulated_world
