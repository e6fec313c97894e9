// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "ground_paint.hpp"
#include "panvo/simulated_world/mesh.hpp"
#include "panvo/simulated_world/random.hpp"

namespace panvo::simulated_world {

/// The appearance of a flat object laid on the ground.
struct Cloth {
  std::uint16_t material = 0;
  double lift_m = 0.003;  ///< above the ground
  Eigen::Vector3f tint = Eigen::Vector3f::Ones();
  double contrast = 1.0;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();    ///< of the texture, m
  Eigen::Vector2d forward = Eigen::Vector2d::UnitX();  ///< along the texture's u
};

/// A rectangle on the plan.
struct Rectangle {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero(), forward = Eigen::Vector2d::UnitX();
  double half_length_m = 0.5, half_width_m = 0.5;

  Eigen::Vector2d at(double forward_m, double left_m) const {
    return middle + forward_m * forward + left_m * Eigen::Vector2d(-forward.y(), forward.x());
  }
};

/// Lays flat objects on the ground so that they follow it.
class Drape {
 public:
  Drape(const Site& site, const GroundPaint& paint) : site_(site), paint_(paint) {}

  /// Adds a strip between two lines with equal numbers of points, at most a metre apart; `right` is on the right when
  /// looking along them.
  void ribbon(std::span<const Eigen::Vector2d> right, std::span<const Eigen::Vector2d> left, const Cloth& cloth);
  /// Adds a small convex polygon, counter-clockwise.
  void polygon(std::span<const Eigen::Vector2d> outline, const Cloth& cloth);
  void rectangle(const Rectangle& where, const Cloth& cloth);
  void disc(const Eigen::Vector2d& middle, double radius_m, int sides, const Cloth& cloth);
  /// Adds a rectangle whose outline is irregular by about `ragged_m`.
  void ragged(const Rectangle& where, double ragged_m, const Cloth& cloth, Random random);
  /// Adds a line of varying width, at most `width_m`.
  void thread(const std::vector<Eigen::Vector2d>& line, double width_m, const Cloth& cloth, Random random);

  Mesh take() { return std::move(mesh_); }

 private:
  std::uint32_t vertex(const Eigen::Vector2d& point, const Cloth& cloth);

  const Site& site_;
  const GroundPaint& paint_;
  Mesh mesh_;
};

}  // namespace panvo::simulated_world
